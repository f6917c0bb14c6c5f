// A picture file becomes finite RGBA floats, upright. Reads what OpenImageIO reads: 8, 16 or 32 bit,
// float, grey, palette, alpha. Pictures whose larger side exceeds kMaxDecodedSide are averaged in whole
// blocks while they are read, so that memory stays bounded.
#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace espalier {

inline constexpr std::size_t kMaxSourcePixels = 100'000'000;
inline constexpr int kMinSourceSide = 8;
inline constexpr int kMaxDecodedSide = 4096;

/// Red, green, blue, alpha; colours are premultiplied by alpha. Integer formats span 0..1, others are cut to
/// ±1e6.
using Rgba = std::array<float, 4>;

struct DecodedPicture {
  int width_px = 0, height_px = 0;  ///< after averaging and turning upright
  int source_width_px = 0, source_height_px = 0;
  bool has_alpha = false;
  std::vector<Rgba> pixels;  ///< row by row from the top

  const Rgba& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width_px + x]; }
};

/// Throws InputError (one line that opens with the path): no such file, a directory, empty, no picture,
/// damaged, larger than kMaxSourcePixels (read from its header), smaller than kMinSourceSide on a side, or
/// with pixels that are no finite numbers.
DecodedPicture decode_picture(const std::filesystem::path& path);

}  // namespace espalier
