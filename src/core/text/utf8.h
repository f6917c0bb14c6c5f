// Which bytes are UTF-8 (RFC 3629): texts from outside, such as names of files, may be any.
#pragma once
#include <string>
#include <string_view>

namespace espalier {

/// How many bytes the character has that `text`, which is not empty, begins with; 0 where that is no UTF-8.
std::size_t utf8_length(std::string_view text);

bool is_utf8_continuation(char byte);

/// Each byte as `\x1b`.
std::string escaped_bytes(std::string_view bytes);

/// The text itself where it is UTF-8; else with each byte that is none as `\xff`.
std::string as_utf8(std::string_view text);

}  // namespace espalier
