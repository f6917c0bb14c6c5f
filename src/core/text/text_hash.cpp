#include <fmt/format.h>

#include <espalier/core/text/text_hash.h>

namespace espalier {

std::uint64_t hash_on(std::uint64_t hash, std::string_view bytes) {
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return hash;
}

std::string text_hash(std::string_view bytes) {
  return fmt::format("{:016x}", hash_on(kHashOfNothing, bytes));
}

}  // namespace espalier
