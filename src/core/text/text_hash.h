// Hashes of texts, files and numbers, by which a change of them is noticed: FNV-1a, 64 bits. Each changed
// byte changes it; it is no protection against those who mean to deceive.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace espalier {

inline constexpr std::uint64_t kHashOfNothing = 0xcbf29ce484222325;

/// Of what `hash` is of, and then these bytes.
std::uint64_t hash_on(std::uint64_t hash, std::string_view bytes);

/// Of 16 hexadecimal digits.
std::string text_hash(std::string_view bytes);

}  // namespace espalier
