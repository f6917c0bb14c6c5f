// Functions of Lua's libraries that take longer the larger a table or a string is: they charge what they do
// (lua_usage.h). pairs() and next() go through a table in the order of its keys, numbers before strings
// before truth values, and tostring() tells no addresses: a file has the same plant in each run.
#pragma once

struct lua_State;

namespace espalier::lsystem {

/// Puts them in place of Lua's.
void replace_table_functions(lua_State* state);

}  // namespace espalier::lsystem
