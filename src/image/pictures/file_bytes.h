// Numbers in the bytes of a file.
#pragma once
#include <cstdint>
#include <string_view>

namespace espalier {

/// A whole number of `count` bytes, up to 8; 0 where the bytes end before.
inline std::uint64_t number_at(std::string_view bytes, std::size_t at, int count, bool big_endian) {
  const auto size = static_cast<std::size_t>(count);
  if (at > bytes.size() || bytes.size() - at < size) return 0;
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + (big_endian ? i : size - 1 - i)]);
  return value;
}

}  // namespace espalier
