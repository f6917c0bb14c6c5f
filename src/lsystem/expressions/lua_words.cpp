#include <algorithm>
#include <array>
#include <cctype>

#include <espalier/lsystem/expressions/lua_words.h>

namespace espalier::lsystem {

namespace {

constexpr std::array kLuaWords{"and",      "break",  "do",   "else", "elseif", "end",  "false", "for",
                               "function", "goto",   "if",   "in",   "local",  "nil",  "not",   "or",
                               "repeat",   "return", "then", "true", "until",  "while"};

}  // namespace

bool is_lua_word(std::string_view name) {
  return std::find(kLuaWords.begin(), kLuaWords.end(), name) != kLuaWords.end();
}

void collect_assigned(std::string_view code, std::set<std::string, std::less<>>& names) {
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  std::string_view before;
  for (std::size_t i = 0; i < code.size();) {
    const std::size_t begin = i;
    while (i < code.size() && is_word(code[i])) ++i;
    if (i == begin) {
      ++i;
      continue;
    }
    const std::string_view word = code.substr(begin, i - begin);
    const std::size_t next = std::min(code.find_first_not_of(" \t", i), code.size());
    const bool assigned = code.substr(next).starts_with('=') && !code.substr(next).starts_with("==");
    if (assigned || before == "function") names.emplace(word);
    before = word;
  }
}

}  // namespace espalier::lsystem
