#include <algorithm>
#include <fstream>
#include <string>

#include <espalier/image/pictures/file_chunks.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostExifBytes = 1 << 20, kMostChunks = 10'000;
constexpr unsigned kOrientationTag = 0x0112;  // EXIF 2.3, §4.6.4

unsigned number_at(const std::string& bytes, std::size_t at, int count, bool big_endian) {
  unsigned value = 0;
  if (at + static_cast<std::size_t>(count) > bytes.size()) return 0;
  for (int i = 0; i < count; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + (big_endian ? i : count - 1 - i)]);
  return value;
}

std::string read_bytes(std::istream& stream, std::size_t count) {
  std::string bytes(count, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

/// Of a TIFF header and its first directory, which is what an EXIF chunk holds.
int orientation_in(const std::string& exif) {
  const std::size_t begin = exif.starts_with("Exif") ? 6 : 0;
  const bool big_endian = exif.compare(begin, 2, "MM") == 0;
  if (!big_endian && exif.compare(begin, 2, "II") != 0) return 1;
  const std::size_t directory = begin + number_at(exif, begin + 4, 4, big_endian);
  const unsigned entries = number_at(exif, directory, 2, big_endian);
  for (unsigned i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + 12 * static_cast<std::size_t>(i);
    if (entry + 12 > exif.size()) break;
    if (number_at(exif, entry, 2, big_endian) != kOrientationTag) continue;
    const unsigned orientation = number_at(exif, entry + 8, 2, big_endian);
    return orientation >= 1 && orientation <= 8 ? static_cast<int>(orientation) : 1;
  }
  return 1;
}

}  // namespace

std::vector<std::array<std::uint8_t, 3>> png_palette(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (read_bytes(stream, 8) != "\x89PNG\r\n\x1a\n") return {};
  for (std::size_t i = 0; i < kMostChunks; ++i) {
    const std::string head = read_bytes(stream, 8);
    if (head.size() < 8) return {};
    const unsigned size = number_at(head, 0, 4, true);
    const std::string kind = head.substr(4);
    if (kind == "IDAT" || kind == "IEND") return {};
    if (kind != "PLTE" || size > 3 * 256) {
      stream.seekg(static_cast<std::streamoff>(size) + 4, std::ios::cur);
      continue;
    }
    const std::string bytes = read_bytes(stream, size);
    std::vector<std::array<std::uint8_t, 3>> palette(bytes.size() / 3);
    for (std::size_t color = 0; color < palette.size(); ++color)
      for (std::size_t c = 0; c < 3; ++c) palette[color][c] = static_cast<std::uint8_t>(bytes[3 * color + c]);
    return palette;
  }
  return {};
}

int webp_orientation(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string head = read_bytes(stream, 12);
  if (!head.starts_with("RIFF") || head.substr(8) != "WEBP") return 1;
  for (std::size_t i = 0; i < kMostChunks; ++i) {
    const std::string chunk = read_bytes(stream, 8);
    if (chunk.size() < 8) return 1;
    const unsigned size = number_at(chunk, 4, 4, false);
    if (chunk.starts_with("EXIF"))
      return orientation_in(read_bytes(stream, std::min<std::size_t>(size, kMostExifBytes)));
    stream.seekg(static_cast<std::streamoff>(size + (size & 1)), std::ios::cur);
  }
  return 1;
}

}  // namespace espalier
