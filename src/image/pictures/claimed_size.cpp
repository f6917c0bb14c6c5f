#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include <espalier/image/pictures/claimed_size.h>
#include <espalier/image/pictures/file_bytes.h>
#include <espalier/image/pictures/jpeg_scans.h>

namespace espalier {

namespace {

using Claim = std::optional<ClaimedSize>;
using Bytes = std::string_view;

std::uint64_t little(Bytes bytes, std::size_t at, int count) { return number_at(bytes, at, count, false); }
std::uint64_t big(Bytes bytes, std::size_t at, int count) { return number_at(bytes, at, count, true); }

Claim size_of(std::uint64_t width, std::uint64_t height) {
  return ClaimedSize{static_cast<double>(width), static_cast<double>(height)};
}

Claim larger(const Claim& a, const Claim& b) {
  if (!a || !b) return a ? a : b;
  return a->width_px * a->height_px >= b->width_px * b->height_px ? a : b;
}

/// PNG specification, §11.2.1.
Claim png_size(Bytes bytes) {
  return bytes.size() < 24 ? Claim{} : size_of(big(bytes, 16, 4), big(bytes, 20, 4));
}

/// ITU-T T.81, §B.2.2.
Claim jpeg_size(Bytes bytes) {
  const std::size_t frame = find_jpeg_frame(bytes);
  return frame == Bytes::npos ? Claim{} : size_of(big(bytes, frame + 7, 2), big(bytes, frame + 5, 2));
}

/// GIF89a, §18.
Claim gif_size(Bytes bytes) {
  return bytes.size() < 10 ? Claim{} : size_of(little(bytes, 6, 2), little(bytes, 8, 2));
}

/// RFC 9649, §2.5 (lossy: VP8, RFC 6386 §9.1), §2.6 (lossless), §2.7 (extended).
Claim webp_size(Bytes bytes) {
  if (bytes.size() < 30) return {};
  const Bytes kind = bytes.substr(12, 4);
  if (kind == "VP8X") return size_of(1 + little(bytes, 24, 3), 1 + little(bytes, 27, 3));
  if (kind == "VP8L")
    return size_of(1 + (little(bytes, 21, 4) & 0x3fff), 1 + (little(bytes, 21, 4) >> 14 & 0x3fff));
  if (kind == "VP8 ") return size_of(little(bytes, 26, 2) & 0x3fff, little(bytes, 28, 2) & 0x3fff);
  return {};
}

/// Of 16 bits in the first version's header, else of 32, where a negative height counts from the top.
Claim bmp_size(Bytes bytes) {
  if (bytes.size() < 26) return {};
  if (little(bytes, 14, 4) == 12) return size_of(little(bytes, 18, 2), little(bytes, 20, 2));
  const auto absolute = [&](std::size_t at) {
    return static_cast<std::uint64_t>(std::llabs(static_cast<std::int32_t>(little(bytes, at, 4))));
  };
  return size_of(absolute(18), absolute(22));
}

/// TIFF 6.0, §2, and BigTIFF: the directories hang together by their last words.
struct TiffReader {
  Bytes bytes;
  bool big_endian = bytes.starts_with('M');
  bool is_big = bytes.find('+') == 2 || bytes.find('+') == 3;
  int word = is_big ? 8 : 4;
  std::size_t entry_bytes = is_big ? 20 : 12;

  std::uint64_t number(std::size_t at, int count) const { return number_at(bytes, at, count, big_endian); }

  /// A whole number of 16, 32 or 64 bits.
  std::uint64_t value(std::size_t entry) const {
    const std::uint64_t type = number(entry + 2, 2);
    return number(entry + (is_big ? 12 : 8), type == 3 ? 2 : type == 4 ? 4 : word);
  }

  Claim size_in(std::size_t directory, std::uint64_t entries) const {
    constexpr std::uint64_t kWidth = 256, kHeight = 257;
    std::map<std::uint64_t, std::uint64_t> values;
    for (std::uint64_t i = 0; i < entries; ++i) {
      const std::size_t entry = directory + static_cast<std::size_t>(i) * entry_bytes;
      if (entry + entry_bytes > bytes.size()) break;
      if (const std::uint64_t tag = number(entry, 2); tag == kWidth || tag == kHeight)
        values[tag] = value(entry);
    }
    return values.size() == 2 ? size_of(values[kWidth], values[kHeight]) : Claim{};
  }

  Claim largest() const {
    constexpr int kMostPages = 100;
    constexpr std::uint64_t kMostEntries = 4096;
    const std::size_t count_bytes = is_big ? 8 : 2;
    Claim claim;
    std::uint64_t at = number(is_big ? 8 : 4, word);
    for (int page = 0; page < kMostPages && at > 0 && at + count_bytes < bytes.size(); ++page) {
      const std::uint64_t entries = number(at, static_cast<int>(count_bytes));
      if (entries > kMostEntries) break;
      claim = larger(claim, size_in(at + count_bytes, entries));
      at = number(at + count_bytes + entries * entry_bytes, word);
    }
    return claim;
  }
};

/// OpenEXR file layout: an attribute is its name, its type, its size and its value, here two corners.
Claim exr_size(Bytes bytes) {
  using namespace std::string_view_literals;
  constexpr Bytes kName = "dataWindow\0box2i\0\x10\0\0\0"sv;
  constexpr std::size_t kMostHeaderBytes = 1 << 20;
  const Bytes header = bytes.substr(0, kMostHeaderBytes);
  Claim claim;
  for (std::size_t at = 0;
       (at = header.find(kName, at)) != Bytes::npos && at + kName.size() + 16 <= header.size();) {
    at += kName.size();
    const auto corner = [&](std::size_t i) {
      return std::int64_t{static_cast<std::int32_t>(little(header, at + 4 * i, 4))};
    };
    claim = larger(claim,
                   size_of(static_cast<std::uint64_t>(std::max<std::int64_t>(0, corner(2) - corner(0) + 1)),
                           static_cast<std::uint64_t>(std::max<std::int64_t>(0, corner(3) - corner(1) + 1))));
  }
  return claim;
}

/// ISO 23008-12, §6.5.3: a property of each item.
Claim heif_size(Bytes bytes) {
  constexpr std::size_t kMostHeaderBytes = 1 << 20;
  const Bytes header = bytes.substr(0, kMostHeaderBytes);
  Claim claim;
  for (std::size_t at = 0; (at = header.find("ispe", at)) != Bytes::npos && at + 16 <= header.size(); at += 4)
    claim = larger(claim, size_of(big(header, at + 8, 4), big(header, at + 12, 4)));
  return claim;
}

/// Two numbers of at most nine digits behind the first two bytes; comments run to the end of their line.
Claim pnm_size(Bytes bytes) {
  std::uint64_t numbers[2];
  std::size_t at = 2;
  for (std::uint64_t& number : numbers) {
    for (; at < bytes.size() && (bytes[at] < '0' || bytes[at] > '9'); ++at)
      if (bytes[at] == '#' && (at = bytes.find('\n', at)) == Bytes::npos) return {};
    number = 0;
    int digits = 0;
    for (; at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9' && digits < 9; ++at, ++digits)
      number = 10 * number + static_cast<std::uint64_t>(bytes[at] - '0');
    if (digits == 0) return {};
  }
  return size_of(numbers[0], numbers[1]);
}

Claim tga_size(Bytes bytes) {
  return bytes.size() < 18 ? Claim{} : size_of(little(bytes, 12, 2), little(bytes, 14, 2));
}

struct FormatClaim {
  Bytes format;
  Claim (*size)(Bytes);
};

constexpr FormatClaim kClaims[] = {
    {"png", png_size},     {"jpeg", jpeg_size},
    {"gif", gif_size},     {"webp", webp_size},
    {"bmp", bmp_size},     {"tiff", [](Bytes bytes) { return TiffReader{bytes}.largest(); }},
    {"openexr", exr_size}, {"heif", heif_size},
    {"pnm", pnm_size},     {"targa", tga_size}};

}  // namespace

std::optional<ClaimedSize> claimed_size(std::string_view bytes, const std::string& format) {
  for (const FormatClaim& claim : kClaims)
    if (claim.format == format) return claim.size(bytes);
  return {};
}

}  // namespace espalier
