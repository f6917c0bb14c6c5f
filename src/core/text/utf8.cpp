#include <fmt/format.h>

#include <algorithm>

#include <espalier/core/text/utf8.h>

namespace espalier {

namespace {

constexpr unsigned kUnicodeEnd = 0x110000, kSurrogates = 0xd800, kSurrogatesEnd = 0xe000;

}  // namespace

bool is_utf8_continuation(char byte) { return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; }

std::size_t utf8_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  unsigned code = first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if (!is_utf8_continuation(text[i])) return 0;
    code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3f);
  }
  constexpr unsigned kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= kSurrogates && code < kSurrogatesEnd;
  return code < kLeast[length] || code >= kUnicodeEnd || is_surrogate ? 0 : length;
}

std::string escaped_bytes(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) text += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
  return text;
}

std::string as_utf8(std::string_view text) {
  std::string valid;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string_view bytes = text.substr(0, std::max<std::size_t>(length, 1));
    valid += length == 0 ? escaped_bytes(bytes) : std::string(bytes);
    text.remove_prefix(bytes.size());
  }
  return valid;
}

}  // namespace espalier
