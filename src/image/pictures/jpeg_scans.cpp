#include <cstdint>

#include <espalier/image/pictures/jpeg_scans.h>

namespace espalier {

namespace {

constexpr auto kNowhere = std::string_view::npos;
constexpr unsigned char kEnd = 0xd9, kScan = 0xda;

unsigned char byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

/// The next FF that begins a marker: not one of coded data (FF 00, restarts), and no fill byte.
std::size_t next_marker(std::string_view bytes, std::size_t at) {
  while ((at = bytes.find('\xff', at)) != kNowhere && at + 1 < bytes.size()) {
    const unsigned char kind = byte_at(bytes, at + 1);
    if (kind == 0xff)
      ++at;
    else if (kind == 0 || kind == 1 || (kind >= 0xd0 && kind <= 0xd7))
      at += 2;
    else
      return at;
  }
  return kNowhere;
}

/// Behind the marker at `at` and what belongs to it.
std::size_t behind_segment(std::string_view bytes, std::size_t at) {
  if (at + 4 > bytes.size()) return bytes.size();
  return at + 2 + (std::size_t{byte_at(bytes, at + 2)} << 8 | byte_at(bytes, at + 3));
}

/// Of the markers up to the end, the first that is of this kind.
template <typename IsWanted>
std::size_t find_marker(std::string_view bytes, std::size_t from, IsWanted is_wanted) {
  for (std::size_t at = next_marker(bytes, from); at != kNowhere;
       at = next_marker(bytes, behind_segment(bytes, at))) {
    const unsigned char kind = byte_at(bytes, at + 1);
    if (is_wanted(kind)) return at;
    if (kind == kEnd) return kNowhere;
  }
  return kNowhere;
}

std::size_t find_scan(std::string_view bytes, std::size_t from) {
  return find_marker(bytes, from, [](unsigned char kind) { return kind == kScan; });
}

}  // namespace

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8\xff"); }

bool is_jpeg_without_end(std::string_view bytes) {
  const std::size_t scan = find_scan(bytes, 2);
  return scan == kNowhere || bytes.find("\xff\xd9", scan) == kNowhere;
}

std::size_t count_jpeg_scans(std::string_view bytes) {
  std::size_t scans = 0;
  for (std::size_t at = find_scan(bytes, 2); at != kNowhere; at = find_scan(bytes, behind_segment(bytes, at)))
    ++scans;
  return scans;
}

std::size_t find_jpeg_frame(std::string_view bytes) {
  const auto is_frame =
      [](unsigned char kind) {  // not tables of Huffman codes, nor of arithmetic ones, nor JPG
        return kind >= 0xc0 && kind <= 0xcf && kind != 0xc4 && kind != 0xc8 && kind != 0xcc;
      };
  return find_marker(bytes, 2, is_frame);
}

}  // namespace espalier
