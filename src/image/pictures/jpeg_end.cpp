#include <cstddef>
#include <fstream>
#include <string>

#include <espalier/core/files.h>
#include <espalier/image/pictures/jpeg_end.h>

namespace espalier {

namespace {

bool opens_like_jpeg(const std::filesystem::path& path) {
  char head[3] = {};
  std::ifstream(path, std::ios::binary).read(head, 3);
  return std::string(head, 3) == "\xff\xd8\xff";
}

/// Where the first scan's header (marker FF DA) begins, past all segments before it; npos where none is.
std::size_t find_first_scan(const std::string& bytes) {
  for (std::size_t at = 2; at + 4 <= bytes.size();) {
    if (bytes[at] != '\xff') return std::string::npos;
    if (bytes[at + 1] == '\xff') {  // a fill byte
      ++at;
      continue;
    }
    if (bytes[at + 1] == '\xda') return at;
    const auto high = static_cast<unsigned char>(bytes[at + 2]),
               low = static_cast<unsigned char>(bytes[at + 3]);
    at += 2 + (std::size_t{high} << 8 | low);
  }
  return std::string::npos;
}

}  // namespace

bool is_jpeg_without_end(const std::filesystem::path& path) {
  if (!opens_like_jpeg(path)) return false;
  const std::string bytes = read_file(path);
  const std::size_t scan = find_first_scan(bytes);
  return scan == std::string::npos || bytes.find("\xff\xd9", scan) == std::string::npos;
}

}  // namespace espalier
