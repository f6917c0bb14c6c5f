// Bytes as text, for files that embed others: RFC 4648, §4.
#pragma once
#include <string>
#include <string_view>

namespace espalier {

std::string base64(std::string_view bytes);

}  // namespace espalier
