// Hashes of texts and files, by which a change of them is noticed: FNV-1a, 64 bits. Each changed byte changes
// it; it is no protection against those who mean to deceive.
#pragma once
#include <string>
#include <string_view>

namespace espalier {

/// 16 hexadecimal digits.
std::string text_hash(std::string_view bytes);

}  // namespace espalier
