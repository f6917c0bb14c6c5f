#include <fmt/format.h>

#include <espalier/core/text/one_line.h>

namespace espalier {

namespace {

constexpr std::size_t kEnd = 110;  ///< of a line that was cut, where messages say what was expected
constexpr unsigned kUnicodeEnd = 0x110000, kSurrogates = 0xd800, kSurrogatesEnd = 0xe000;

bool is_continuation(char byte) { return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; }

/// How many bytes the character has that `text` begins with; 0 where that is no UTF-8 (RFC 3629).
std::size_t length_of_character(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  unsigned code = first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if (!is_continuation(text[i])) return 0;
    code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3f);
  }
  constexpr unsigned kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= kSurrogates && code < kSurrogatesEnd;
  return code < kLeast[length] || code >= kUnicodeEnd || is_surrogate ? 0 : length;
}

/// C0 and C1 controls and DEL: what terminals obey.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  return first < 0x20 || first == 0x7f || (first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0);
}

std::string escaped(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) text += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
  return text;
}

/// What a library puts before its reason: "[json.exception.parse_error.101] ".
std::string_view without_library_mark(std::string_view text) {
  constexpr std::string_view kMark = "[json.exception.";
  if (!text.starts_with(kMark)) return text;
  const std::size_t end = text.find("] ");
  return end == std::string_view::npos ? text : text.substr(end + 2);
}

std::string readable(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    if (const std::string_view rest = without_library_mark(text); rest.size() < text.size()) {
      text = rest;
      continue;
    }
    const std::size_t length = length_of_character(text);
    const std::string_view character = text.substr(0, length == 0 ? 1 : length);
    if (character == "\n")
      line += ' ';
    else if (length == 0 || is_control(character))
      line += escaped(character);
    else
      line += character;
    text.remove_prefix(character.size());
  }
  return line;
}

/// At `at` or up to three bytes before it, where a character begins.
std::size_t character_at(const std::string& line, std::size_t at) {
  while (at > 0 && at < line.size() && is_continuation(line[at])) --at;
  return at;
}

}  // namespace

std::string one_line(std::string_view text, std::size_t longest) {
  if (text.size() > 4 * longest)  // what is cut away need not be read
    return one_line(std::string(text.substr(0, longest)) + std::string(text.substr(text.size() - longest)),
                    longest);
  std::string line = readable(text);
  const std::string mark = " … ";
  if (line.size() <= longest) return line;
  const std::size_t begin = character_at(line, longest - kEnd - mark.size());
  return line.substr(0, begin) + mark + line.substr(character_at(line, line.size() - kEnd));
}

}  // namespace espalier
