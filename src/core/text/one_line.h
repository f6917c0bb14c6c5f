// What files, names and libraries put into a message, as a line that a terminal or a table can be given.
#pragma once
#include <string>
#include <string_view>

namespace espalier {

/// At most `longest` bytes, which are more than 120: control characters and bytes that are no UTF-8 are
/// written as `\x1b`, line breaks as blanks, and the middle of what is too long is left out.
std::string one_line(std::string_view text, std::size_t longest);

}  // namespace espalier
