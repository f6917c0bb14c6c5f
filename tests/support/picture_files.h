// Picture files for tests: drawn ones in any format that OpenImageIO writes, and broken ones byte by byte.
#pragma once
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <espalier/image/masks/mask.h>

namespace espalier::test {

/// Whether pixel (x, y) of a `size_px`² picture shows the tree: a round crown left of the middle on a
/// trunk, with its base at 0.9 of the height.
inline bool drawn_tree(int x, int y, int size_px) {
  const double u = (x + 0.5) / size_px - 0.42, v = (y + 0.5) / size_px;
  const bool crown = u * u + (v - 0.4) * (v - 0.4) < 0.25 * 0.25;
  const bool trunk = std::fabs(u) < 0.03 && v > 0.4 && v < 0.9;
  return crown || trunk;
}

inline Mask drawn_tree_mask(int size_px) {
  Mask mask(size_px, size_px);
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x) mask.set(x, y, drawn_tree(x, y, size_px));
  return mask;
}

/// A picture as floats, `channels` a pixel, to be written in another type.
struct Samples {
  int width_px = 0, height_px = 0, channels = 1;
  std::vector<float> values;

  float& at(int x, int y, int c = 0) {
    return values[(static_cast<std::size_t>(y) * width_px + x) * channels + c];
  }
};

inline Samples blank(int width_px, int height_px, const std::vector<float>& color) {
  Samples samples{width_px, height_px, static_cast<int>(color.size()), {}};
  for (int i = 0; i < width_px * height_px; ++i)
    samples.values.insert(samples.values.end(), color.begin(), color.end());
  return samples;
}

/// The drawn tree in one colour on another.
inline Samples draw_tree(int size_px, const std::vector<float>& tree, const std::vector<float>& background) {
  Samples samples = blank(size_px, size_px, background);
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x)
      if (drawn_tree(x, y, size_px))
        for (std::size_t c = 0; c < tree.size(); ++c) samples.at(x, y, static_cast<int>(c)) = tree[c];
  return samples;
}

/// Writes in the format of the path's extension. `orientation` is the EXIF one.
inline void write_samples(const std::filesystem::path& path, const Samples& samples,
                          OIIO::TypeDesc type = OIIO::TypeDesc::UINT8, int orientation = 1) {
  auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output) << path << ": " << OIIO::geterror();
  OIIO::ImageSpec spec(samples.width_px, samples.height_px, samples.channels, type);
  if (orientation != 1) spec.attribute("Orientation", orientation);
  ASSERT_TRUE(output->open(path.string(), spec)) << output->geterror();
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, samples.values.data())) << output->geterror();
  ASSERT_TRUE(output->close());
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Cuts a file to this share of its length.
inline void cut_off(const std::filesystem::path& path, double share) {
  const auto size = static_cast<double>(std::filesystem::file_size(path));
  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(size * share));
}

inline std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

/// CRC-32 as in the PNG specification, annex D.
inline std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

/// A grey PNG that claims this size and holds no pixels.
inline std::string png_claiming(std::uint32_t width_px, std::uint32_t height_px) {
  const auto chunk = [](const std::string& typed_data) {
    return big_endian(static_cast<std::uint32_t>(typed_data.size() - 4)) + typed_data +
           big_endian(crc32(typed_data));
  };
  const std::string empty_deflate("\x78\x9c\x03\x00\x00\x00\x00\x01", 8);
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR" + big_endian(width_px) + big_endian(height_px) +
               std::string("\x08\x00\x00\x00\x00", 5)) +
         chunk("IDAT" + empty_deflate) + chunk("IEND");
}

/// A GIF header that claims a screen and a picture of this size.
inline std::string gif_claiming(int width_px, int height_px) {
  const auto little = [](int value) {
    return std::string{static_cast<char>(value), static_cast<char>(value >> 8)};
  };
  return "GIF89a" + little(width_px) + little(height_px) +
         std::string("\x80\x00\x00\x00\x00\x00\xff\xff\xff,", 10) + std::string(4, '\0') + little(width_px) +
         little(height_px) + std::string("\x00\x02\x02\x4c\x01\x00;", 7);
}

/// The kinds of bad picture that every command must refuse; each is made by `write` at a path.
struct BadPicture {
  const char* file;     ///< its name
  const char* message;  ///< a part of what the error must say
  void (*write)(const std::filesystem::path& path);
};

inline const std::vector<BadPicture>& bad_pictures() {
  namespace fs = std::filesystem;
  static const std::vector<BadPicture> all = {
      {"missing.png", "no such file", [](const fs::path&) {}},
      {"empty.png", "is empty", [](const fs::path& path) { write_bytes(path, ""); }},
      {"folder.png", "is a directory", [](const fs::path& path) { fs::create_directory(path); }},
      {"text.png", "no picture that can be read",
       [](const fs::path& path) { write_bytes(path, "a line of text\n"); }},
      {"text.txt", "no picture that can be read",
       [](const fs::path& path) { write_bytes(path, "a line of text\n"); }},
      {"zeros.png", "no picture that can be read",
       [](const fs::path& path) { write_bytes(path, std::string(5000, '\0')); }},
      {"cut.png", "cut off",
       [](const fs::path& path) { write_samples(path, draw_tree(256, {1}, {0})), cut_off(path, 0.5); }},
      {"cut_in_header.png", "no picture that can be read",
       [](const fs::path& path) { write_samples(path, draw_tree(256, {1}, {0})), cut_off(path, 0.03); }},
      {"cut.jpg", "cut off",
       [](const fs::path& path) {
         write_samples(path, draw_tree(256, {1, 1, 1}, {0, 0, 0})), cut_off(path, 0.5);
       }},
      {"cut.tif", "cut off",
       [](const fs::path& path) {
         Samples noise = draw_tree(256, {1}, {0});
         for (std::size_t i = 0; i < noise.values.size(); ++i)
           noise.values[i] = 0.9f * noise.values[i] + 0.1f * static_cast<float>(i * 7919 % 101) / 101;
         write_samples(path, noise), cut_off(path, 0.5);
       }},
      {"zero_pixels.pgm", "0×0", [](const fs::path& path) { write_bytes(path, "P5 0 0 255\n"); }},
      {"one_pixel.png", "1×1", [](const fs::path& path) { write_samples(path, blank(1, 1, {1})); }},
      {"one_row.png", "64×1", [](const fs::path& path) { write_samples(path, blank(64, 1, {1})); }},
      {"claims_1e10.png", "100000×100000",
       [](const fs::path& path) { write_bytes(path, png_claiming(100'000, 100'000)); }},
      {"claims_1e8.png", "9999×9999",
       [](const fs::path& path) { write_bytes(path, png_claiming(9999, 9999)); }},
      {"claims_4e9.gif", "65535×65535",
       [](const fs::path& path) { write_bytes(path, gif_claiming(65535, 65535)); }},
      {"black.png", "shows no tree", [](const fs::path& path) { write_samples(path, blank(64, 64, {0})); }},
      {"white.png", "shows no tree", [](const fs::path& path) { write_samples(path, blank(64, 64, {1})); }},
      {"green.jpg", "shows no tree",
       [](const fs::path& path) {
         write_samples(path, blank(64, 64, {.1f, .5f, .1f}));
       }},
      {"transparent.png", "shows no tree",
       [](const fs::path& path) {
         write_samples(path, blank(64, 64, {0, 0, 0, 0}));
       }},
      {"dot.png", "shows no tree",
       [](const fs::path& path) {
         Samples dot = blank(512, 512, {0});
         dot.at(100, 100) = 1;
         write_samples(path, dot);
       }},
      {"nan.exr", "not a finite number",
       [](const fs::path& path) {
         Samples nan = draw_tree(64, {1, 1, 1}, {0, 0, 0});
         nan.at(5, 3, 1) = std::numeric_limits<float>::quiet_NaN();
         write_samples(path, nan, OIIO::TypeDesc::FLOAT);
       }},
      {"infinite.tif", "not a finite number",
       [](const fs::path& path) {
         Samples infinite = draw_tree(64, {1}, {0});
         infinite.at(5, 3) = std::numeric_limits<float>::infinity();
         write_samples(path, infinite, OIIO::TypeDesc::FLOAT);
       }},
  };
  return all;
}

}  // namespace espalier::test
