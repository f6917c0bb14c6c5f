#include <algorithm>

#include <espalier/image/pictures/file_bytes.h>
#include <espalier/image/pictures/file_chunks.h>

namespace espalier {

namespace {

constexpr std::size_t kMostExifBytes = 1 << 20, kMostChunks = 10'000;
constexpr unsigned kOrientationTag = 0x0112;  // EXIF 2.3, §4.6.4

/// What there is of these bytes.
std::string_view bytes_at(std::string_view bytes, std::size_t at, std::size_t count) {
  return at < bytes.size() ? bytes.substr(at, count) : std::string_view();
}

/// Of a TIFF header and its first directory, which is what an EXIF chunk holds.
int orientation_in(std::string_view exif) {
  const std::size_t begin = exif.starts_with("Exif") ? 6 : 0;
  const bool big_endian = bytes_at(exif, begin, 2) == "MM";
  if (!big_endian && bytes_at(exif, begin, 2) != "II") return 1;
  const auto directory = static_cast<std::size_t>(begin + number_at(exif, begin + 4, 4, big_endian));
  const std::uint64_t entries = number_at(exif, directory, 2, big_endian);
  for (std::uint64_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + 12 * static_cast<std::size_t>(i);
    if (entry + 12 > exif.size()) break;
    if (number_at(exif, entry, 2, big_endian) != kOrientationTag) continue;
    const std::uint64_t orientation = number_at(exif, entry + 8, 2, big_endian);
    return orientation >= 1 && orientation <= 8 ? static_cast<int>(orientation) : 1;
  }
  return 1;
}

}  // namespace

std::vector<std::array<std::uint8_t, 3>> png_palette(std::string_view bytes) {
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) return {};
  std::size_t at = 8;
  for (std::size_t i = 0; i < kMostChunks && at + 8 <= bytes.size(); ++i) {
    const auto size = static_cast<std::size_t>(number_at(bytes, at, 4, true));
    const std::string_view kind = bytes.substr(at + 4, 4);
    if (kind == "IDAT" || kind == "IEND") return {};
    if (kind != "PLTE" || size > 3 * 256) {
      at += 8 + size + 4;
      continue;
    }
    const std::string_view colors = bytes_at(bytes, at + 8, size);
    std::vector<std::array<std::uint8_t, 3>> palette(colors.size() / 3);
    for (std::size_t color = 0; color < palette.size(); ++color)
      for (std::size_t c = 0; c < 3; ++c)
        palette[color][c] = static_cast<std::uint8_t>(colors[3 * color + c]);
    return palette;
  }
  return {};
}

int webp_orientation(std::string_view bytes) {
  if (!bytes.starts_with("RIFF") || bytes_at(bytes, 8, 4) != "WEBP") return 1;
  std::size_t at = 12;
  for (std::size_t i = 0; i < kMostChunks && at + 8 <= bytes.size(); ++i) {
    const auto size = static_cast<std::size_t>(number_at(bytes, at + 4, 4, false));
    if (bytes.substr(at).starts_with("EXIF"))
      return orientation_in(bytes_at(bytes, at + 8, std::min(size, kMostExifBytes)));
    at += 8 + size + (size & 1);
  }
  return 1;
}

}  // namespace espalier
