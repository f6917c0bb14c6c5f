#include <shared_mutex>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/image/codecs/codecs.h>
#include <espalier/image/pictures/animation.h>

namespace espalier {

namespace {

std::unique_ptr<AnimationOutput> open_gif(int width_px, int height_px, int frames, double frame_s) {
  std::string error;
  const PictureCodecs& codecs = picture_codecs();
  const std::shared_lock in_use(picture_codecs_in_use());
  auto output = codecs.encode_gif(width_px, height_px, frames, frame_s, error);
  if (!output) throw InternalError("GIF encoding failed: " + error);
  return output;
}

}  // namespace

struct Animation::Encoder {
  int width_px, height_px, frames;
  std::unique_ptr<AnimationOutput> output;
  int added = 0;

  void check(bool succeeded) const {
    if (!succeeded) throw InternalError("GIF encoding failed: " + output->error());
  }
};

Animation::Animation(int width_px, int height_px, int frames, double frame_s) {
  ESPALIER_CHECK_EQ(frames >= 1 && frame_s >= 0.02, true);
  encoder_ = std::make_unique<Encoder>(
      Encoder{width_px, height_px, frames, open_gif(width_px, height_px, frames, frame_s)});
}

Animation::~Animation() = default;

void Animation::add(const Picture& picture) {
  static_assert(sizeof(Rgb) == 3);
  ESPALIER_CHECK_EQ(picture.width_px, encoder_->width_px);
  ESPALIER_CHECK_EQ(picture.height_px, encoder_->height_px);
  ++encoder_->added;
  const std::shared_lock in_use(picture_codecs_in_use());
  encoder_->check(encoder_->output->add(reinterpret_cast<const std::uint8_t*>(picture.pixels.data())));
}

void Animation::write(const std::filesystem::path& path) {
  ESPALIER_CHECK_EQ(encoder_->added, encoder_->frames);
  {
    const std::shared_lock in_use(picture_codecs_in_use());
    encoder_->check(encoder_->output->close());
  }
  write_file_atomically(path, encoder_->output->bytes());
}

}  // namespace espalier
