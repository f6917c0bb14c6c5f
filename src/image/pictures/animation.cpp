#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <string_view>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/image/pictures/animation.h>

namespace espalier {

struct Animation::Encoder {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory{bytes};
  std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("gif");
  std::vector<OIIO::ImageSpec> frames;
  int added = 0;

  void check(bool succeeded) const {
    if (!succeeded)
      throw InternalError("GIF encoding failed: " + (output ? output->geterror() : OIIO::geterror()));
  }
};

Animation::Animation(int width_px, int height_px, int frames, double frame_s)
    : encoder_(std::make_unique<Encoder>()) {
  ESPALIER_CHECK_EQ(frames >= 1 && frame_s >= 0.02, true);
  OIIO::ImageSpec spec(width_px, height_px, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("FramesPerSecond", static_cast<float>(1 / frame_s));
  spec.attribute("oiio:ColorSpace", "sRGB");
  encoder_->frames.assign(static_cast<std::size_t>(frames), spec);
  encoder_->check(encoder_->output && encoder_->output->set_ioproxy(&encoder_->memory) &&
                  encoder_->output->open("animation.gif", frames, encoder_->frames.data()));
}

Animation::~Animation() = default;

void Animation::add(const Picture& picture) {
  const OIIO::ImageSpec& spec = encoder_->frames.front();
  ESPALIER_CHECK_EQ(picture.width_px, spec.width);
  ESPALIER_CHECK_EQ(picture.height_px, spec.height);
  if (encoder_->added++ > 0)
    encoder_->check(encoder_->output->open("animation.gif", spec, OIIO::ImageOutput::AppendSubimage));
  encoder_->check(encoder_->output->write_image(OIIO::TypeDesc::UINT8, picture.pixels.data()));
}

void Animation::write(const std::filesystem::path& path) {
  ESPALIER_CHECK_EQ(encoder_->added, static_cast<int>(encoder_->frames.size()));
  encoder_->check(encoder_->output->close());
  write_file_atomically(path,
                        {reinterpret_cast<const char*>(encoder_->bytes.data()), encoder_->bytes.size()});
}

}  // namespace espalier
