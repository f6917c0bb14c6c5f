#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include <espalier/image/pictures/claimed_size.h>

namespace espalier {

namespace {

/// The first bytes of a file; `count` of them were there.
struct Header {
  std::array<unsigned char, 30> bytes{};
  std::streamsize count = 0;

  bool has(std::size_t at, std::string_view text) const {
    return std::equal(text.begin(), text.end(), bytes.begin() + at,
                      [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
  }
  int little_endian(std::size_t at, int byte_count) const {
    int value = 0;
    for (int i = 0; i < byte_count; ++i) value |= bytes[at + i] << 8 * i;
    return value;
  }
};

Header read_header(const std::filesystem::path& path) {
  Header header;
  std::ifstream stream(path, std::ios::binary);
  stream.read(reinterpret_cast<char*>(header.bytes.data()),
              static_cast<std::streamsize>(header.bytes.size()));
  header.count = stream.gcount();
  return header;
}

/// RFC 9649, §2.5 (lossy: VP8, RFC 6386 §9.1), §2.6 (lossless), §2.7 (extended).
std::optional<ClaimedSize> webp_size(const Header& header) {
  if (header.has(12, "VP8X"))
    return ClaimedSize{1 + header.little_endian(24, 3), 1 + header.little_endian(27, 3)};
  if (header.has(12, "VP8L")) {
    const auto bits = static_cast<unsigned>(header.little_endian(21, 4));
    return ClaimedSize{1 + static_cast<int>(bits & 0x3fff), 1 + static_cast<int>(bits >> 14 & 0x3fff)};
  }
  if (header.has(12, "VP8 "))
    return ClaimedSize{header.little_endian(26, 2) & 0x3fff, header.little_endian(28, 2) & 0x3fff};
  return {};
}

}  // namespace

std::optional<ClaimedSize> claimed_size(const std::filesystem::path& path) {
  const Header header = read_header(path);
  if (header.count >= 10 && header.has(0, "GIF8"))
    return ClaimedSize{header.little_endian(6, 2), header.little_endian(8, 2)};
  if (header.count == 30 && header.has(0, "RIFF") && header.has(8, "WEBP")) return webp_size(header);
  return {};
}

}  // namespace espalier
