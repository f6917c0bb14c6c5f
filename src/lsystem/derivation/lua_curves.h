// Functions that a file gives by numbers, as Lua sees them: f(x), for what is no Program.
#pragma once
#include <span>
#include <string>

#include <espalier/core/curves/curve.h>
#include <espalier/lsystem/expressions/lua_state.h>

namespace espalier::lsystem {

/// Gives Lua the functions by their names. The curves must outlive it, and may change.
void add_curves(LuaState& lua, std::span<const std::string> names, std::span<const Curve> curves);

}  // namespace espalier::lsystem
