// A picture file becomes finite RGBA floats, upright: PNG, JPEG, GIF, TIFF, WebP, BMP, EXR, HEIC, AVIF, PNM
// and TGA, of 8, 16 or 32 bit, float, grey, palette, alpha. Its decoder works in a process of its own.
// Pictures whose larger side exceeds kMaxDecodedSide are averaged in whole blocks while they are read, so
// that memory stays bounded.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
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
  int bits = 0;                                      ///< of samples that are whole numbers, 8 or 16; else 0
  bool is_grey = false;                              ///< the file has one channel of colour
  std::vector<std::array<std::uint8_t, 3>> palette;  ///< of a PNG; empty where it has none
  int frame = 0,
      blank_frames = 0;      ///< the frame that was read, counted from 1, and how many before it are blank
  std::vector<Rgba> pixels;  ///< row by row from the top

  const Rgba& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width_px + x]; }
};

/// `frame`: of an animation or of pages, counted from 1; 0: the first that is not all of one colour. Throws
/// InputError (one line that opens with the path): no such file, a directory, empty, no picture,
/// no such frame, damaged, larger than kMaxSourcePixels (read from its header), smaller than kMinSourceSide
/// on a side, or with pixels that are no finite numbers; and where its decoder crashes, or takes more time or
/// memory than a picture of this size may.
DecodedPicture decode_picture(const std::filesystem::path& path, int frame = 0);

}  // namespace espalier
