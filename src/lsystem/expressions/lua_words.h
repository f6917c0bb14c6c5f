// What the notation takes from Lua's: its reserved words, and the names that a file's Lua code gives values.
#pragma once
#include <set>
#include <string>
#include <string_view>

namespace espalier::lsystem {

bool is_lua_word(std::string_view name);

/// Names that Lua code gives a value: words before a '=' or after "function". They are Lua's from then on.
void collect_assigned(std::string_view code, std::set<std::string, std::less<>>& names);

}  // namespace espalier::lsystem
