// Colour pictures to be written: 8-bit sRGB, row 0 at the top. Files are written whole or not at all.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <espalier/image/masks/mask.h>

namespace espalier {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

struct Picture {
  int width_px = 0, height_px = 0;
  std::vector<Rgb> pixels;  ///< width_px · height_px, row by row

  Picture() = default;
  Picture(int width, int height, Rgb fill = {})
      : width_px(width), height_px(height), pixels(static_cast<std::size_t>(width) * height, fill) {}
  Rgb& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width_px + x]; }
  const Rgb& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width_px + x]; }
};

/// Writes a PNG through a temporary file and a rename. Throws InputError (one line) where the path
/// cannot be written or the disk is full; an existing file is then untouched.
void write_png(const std::filesystem::path& path, const Picture& picture);

/// The bytes of a PNG. cover: 0 … 255 a pixel, its opacity; empty: no such channel.
std::string png_bytes(const Picture& picture, const std::vector<std::uint8_t>& cover = {});

/// One-channel PNG: tree 255, background 0.
void write_mask_png(const std::filesystem::path& path, const Mask& mask);

/// Agreement white, background black, missed (target only) blue, surplus (candidate only) orange:
/// colours of Okabe and Ito (2008) that colour-blind people tell apart.
Picture overlay(const Mask& candidate, const Mask& target);

inline constexpr Rgb kMissedColor{0, 114, 178};
inline constexpr Rgb kSurplusColor{230, 159, 0};

}  // namespace espalier
