#include <espalier/core/text/one_line.h>
#include <espalier/core/text/utf8.h>

namespace espalier {

namespace {

constexpr std::size_t kEnd = 110;  ///< of a line that was cut, where messages say what was expected

/// C0 and C1 controls and DEL: what terminals obey.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  return first < 0x20 || first == 0x7f || (first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0);
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
    const std::size_t length = utf8_length(text);
    const std::string_view character = text.substr(0, length == 0 ? 1 : length);
    if (character == "\n")
      line += ' ';
    else if (length == 0 || is_control(character))
      line += escaped_bytes(character);
    else
      line += character;
    text.remove_prefix(character.size());
  }
  return line;
}

/// At `at` or up to three bytes before it, where a character begins.
std::size_t character_at(const std::string& line, std::size_t at) {
  while (at > 0 && at < line.size() && is_utf8_continuation(line[at])) --at;
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
