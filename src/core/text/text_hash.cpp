#include <fmt/format.h>

#include <cstdint>

#include <espalier/core/text/text_hash.h>

namespace espalier {

std::string text_hash(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ull;
  return fmt::format("{:016x}", hash);
}

}  // namespace espalier
