#include <shared_mutex>
#include <string_view>
#include <utility>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/image/codecs/codecs.h>
#include <espalier/image/pictures/picture.h>

namespace espalier {

namespace {

/// The bytes of a PNG file of 8-bit samples, `channels` a pixel.
std::string encode_png(const std::filesystem::path& path, int width_px, int height_px, int channels,
                       const std::uint8_t* samples) {
  if (width_px < 1 || height_px < 1)
    throw_input_error("{}: a picture of {}×{} pixels cannot be written", path.string(), width_px, height_px);
  const PictureCodecs& codecs = picture_codecs();
  const std::shared_lock in_use(picture_codecs_in_use());
  EncodedPicture encoded =
      codecs.encode_png(path.filename().string(), width_px, height_px, channels, samples);
  if (!encoded.error.empty()) throw InternalError(encoded.error);
  return std::move(encoded.bytes);
}

}  // namespace

std::string png_bytes(const Picture& picture, const std::vector<std::uint8_t>& cover) {
  const bool covered = !cover.empty();
  std::vector<std::uint8_t> samples;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const Rgb& pixel = picture.pixels[i];
    samples.insert(samples.end(), {pixel.r, pixel.g, pixel.b});
    if (covered) samples.push_back(cover[i]);
  }
  return encode_png("picture.png", picture.width_px, picture.height_px, covered ? 4 : 3, samples.data());
}

void write_png(const std::filesystem::path& path, const Picture& picture) {
  static_assert(sizeof(Rgb) == 3);
  const auto* samples = reinterpret_cast<const std::uint8_t*>(picture.pixels.data());
  write_file_atomically(path, encode_png(path, picture.width_px, picture.height_px, 3, samples));
}

void write_mask_png(const std::filesystem::path& path, const Mask& mask) {
  std::vector<std::uint8_t> samples;
  samples.reserve(static_cast<std::size_t>(mask.width_px()) * mask.height_px());
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x) samples.push_back(mask.get(x, y) ? 255 : 0);
  write_file_atomically(path, encode_png(path, mask.width_px(), mask.height_px(), 1, samples.data()));
}

Picture overlay(const Mask& candidate, const Mask& target) {
  ESPALIER_CHECK_EQ(candidate.width_px(), target.width_px());
  ESPALIER_CHECK_EQ(candidate.height_px(), target.height_px());
  constexpr Rgb kColors[2][2] = {{{0, 0, 0}, kMissedColor}, {kSurplusColor, {255, 255, 255}}};
  Picture picture(target.width_px(), target.height_px());
  for (int y = 0; y < target.height_px(); ++y)
    for (int x = 0; x < target.width_px(); ++x)
      picture.at(x, y) = kColors[candidate.get(x, y)][target.get(x, y)];
  return picture;
}

}  // namespace espalier
