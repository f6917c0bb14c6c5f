#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <utility>
#include <vector>

#include <espalier/image/openimageio/openimageio_codecs.h>

namespace espalier {

namespace {

/// 0 for samples that are no whole numbers of 8 or 16 bits.
int bits_of(const OIIO::TypeDesc& format) {
  if (format == OIIO::TypeDesc::UINT8) return 8;
  return format == OIIO::TypeDesc::UINT16 ? 16 : 0;
}

/// GIF's reader says that alpha is behind the last channel.
int alpha_of(const OIIO::ImageSpec& spec) {
  return spec.alpha_channel < spec.nchannels ? spec.alpha_channel : spec.channelindex("A");
}

PictureLayout layout_of(const OIIO::ImageSpec& spec) {
  return {.width_px = spec.width,
          .height_px = spec.height,
          .layers = spec.depth,
          .channels = spec.nchannels,
          .red = spec.channelindex("R"),
          .green = spec.channelindex("G"),
          .blue = spec.channelindex("B"),
          .alpha = alpha_of(spec),
          .orientation = spec.get_int_attribute("Orientation", 1),
          .tile_rows = spec.tile_width == 0 ? 0 : spec.tile_height,
          .tile_columns = spec.tile_width,
          .bits = bits_of(spec.format)};
}

constexpr int kMostFrames = 10'000;

class FileInput : public PictureInput {
 public:
  explicit FileInput(std::unique_ptr<OIIO::ImageInput> input)
      : input_(std::move(input)),
        spec_(input_->spec()),
        frame_(input_->current_subimage()),
        layout_(layout_of(spec_)) {}

  const PictureLayout& layout() const override { return layout_; }

  bool read_rows(int begin, int end, float* samples) override {
    const bool read =
        spec_.tile_width == 0 ? read_scanlines(begin, end, samples) : read_tiles(begin, end, samples);
    return read && !input_->has_error();  // TIFF's reader returns true for rows that are not in the file
  }

  bool next_frame() override {
    if (!input_->seek_subimage(frame_ + 1, 0)) return false;
    ++frame_;
    spec_ = input_->spec();
    layout_ = layout_of(spec_);
    return true;
  }

  std::string error() override { return input_->geterror(); }

 private:
  bool read_scanlines(int begin, int end, float* samples) {
    return input_->read_scanlines(frame_, 0, spec_.y + begin, spec_.y + end, spec_.z, 0, spec_.nchannels,
                                  OIIO::TypeDesc::FLOAT, samples);
  }

  bool read_tiles(int begin, int end, float* samples) {
    return input_->read_tiles(frame_, 0, spec_.x, spec_.x + spec_.width, spec_.y + begin, spec_.y + end,
                              spec_.z, spec_.z + 1, 0, spec_.nchannels, OIIO::TypeDesc::FLOAT, samples);
  }

  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
  int frame_;
  PictureLayout layout_;
};

class GifOutput : public AnimationOutput {
 public:
  GifOutput(int width_px, int height_px, int frames, double frame_s) {
    OIIO::ImageSpec spec(width_px, height_px, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("FramesPerSecond", static_cast<float>(1 / frame_s));
    spec.attribute("oiio:ColorSpace", "sRGB");
    frames_.assign(static_cast<std::size_t>(frames), spec);
  }

  bool open() {
    return output_ && output_->set_ioproxy(&memory_) &&
           output_->open("animation.gif", static_cast<int>(frames_.size()), frames_.data());
  }

  bool add(const std::uint8_t* rgb) override {
    if (added_++ > 0 && !output_->open("animation.gif", frames_.front(), OIIO::ImageOutput::AppendSubimage))
      return false;
    return output_->write_image(OIIO::TypeDesc::UINT8, rgb);
  }

  bool close() override { return output_->close(); }
  std::string bytes() const override { return {bytes_.begin(), bytes_.end()}; }
  std::string error() override { return output_ ? output_->geterror() : OIIO::geterror(); }

 private:
  std::vector<unsigned char> bytes_;
  OIIO::Filesystem::IOVecOutput memory_{bytes_};
  std::unique_ptr<OIIO::ImageOutput> output_ = OIIO::ImageOutput::create("gif");
  std::vector<OIIO::ImageSpec> frames_;
  int added_ = 0;
};

/// By its own name: asked by that of a file, OpenImageIO would try one reader after the other.
std::unique_ptr<OIIO::ImageInput> open_file(const std::string& path, const std::string& reader,
                                            std::string& error) {
  auto input = OIIO::ImageInput::create(reader);
  OIIO::ImageSpec spec;
  if (input && input->open(path, spec)) return input;
  error = input ? input->geterror() : OIIO::geterror();
  return nullptr;
}

/// OpenEXR has threads of its own, which OpenImageIO starts and ends with the next file: with this one, of a
/// pixel.
void end_threads_of_exr() {
  OIIO::attribute("exr_threads", -1);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create("openexr");
  const float pixel = 0;
  if (output && output->set_ioproxy(&memory) &&
      output->open("pixel.exr", OIIO::ImageSpec(1, 1, 1, OIIO::TypeDesc::FLOAT)) &&
      output->write_image(OIIO::TypeDesc::FLOAT, &pixel))
    output->close();
}

class OpenImageIoCodecs : public PictureCodecs {
 public:
  /// Pictures are decoded in forked processes, where threads of OpenImageIO's pool are not.
  OpenImageIoCodecs() {
    OIIO::attribute("threads", 1);
    end_threads_of_exr();
  }

  std::unique_ptr<PictureInput> open(const std::string& path, const std::string& reader, int frame,
                                     std::string& error) const override {
    auto input = open_file(path, reader, error);
    if (input && (frame == 0 || input->seek_subimage(frame, 0)))
      return std::make_unique<FileInput>(std::move(input));
    if (input) error = "it has no such frame";
    return nullptr;
  }

  int count_frames(const std::string& path, const std::string& reader) const override {
    std::string error;
    const auto input = open_file(path, reader, error);
    int frames = 0;
    while (input && frames < kMostFrames && input->seek_subimage(frames, 0)) ++frames;
    return frames;
  }

  EncodedPicture encode_png(const std::string& name, int width_px, int height_px, int channels,
                            const std::uint8_t* samples) const override {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create("png");
    OIIO::ImageSpec spec(width_px, height_px, channels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (!output || !output->set_ioproxy(&memory) || !output->open(name, spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, samples) || !output->close())
      return {"", "PNG encoding failed: " + (output ? output->geterror() : OIIO::geterror())};
    return {{bytes.begin(), bytes.end()}, ""};
  }

  std::unique_ptr<AnimationOutput> encode_gif(int width_px, int height_px, int frames, double frame_s,
                                              std::string& error) const override {
    auto output = std::make_unique<GifOutput>(width_px, height_px, frames, frame_s);
    if (output->open()) return output;
    error = output->error();
    return nullptr;
  }
};

}  // namespace

}  // namespace espalier

extern "C" const espalier::PictureCodecs* espalier_openimageio_codecs() {
  static const espalier::OpenImageIoCodecs codecs;
  return &codecs;
}
