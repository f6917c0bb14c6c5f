// Surroundings as Lua sees them: inside(volume, x, y, z), distance(volume, x, y, z), value(field, x, y),
// light(x, y, z) and skylight(x, y, z), for what is no Program. Volumes and fields are opaque values.
#pragma once
#include <espalier/lsystem/expressions/lua_state.h>
#include <espalier/lsystem/notation/grammar.h>
#include <espalier/lsystem/surroundings/surroundings.h>

namespace espalier::lsystem {

/// Both must outlive the functions.
void add_surroundings(LuaState& lua, const Surroundings& surroundings);

/// Gives Lua the names of the file's volumes and fields.
void name_surroundings(LuaState& lua, const Names& names);

}  // namespace espalier::lsystem
