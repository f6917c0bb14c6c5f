#include <lua.hpp>

#include <espalier/lsystem/derivation/lua_curves.h>

namespace espalier::lsystem {

namespace {

int lua_curve(lua_State* state) {
  const auto& curve = *static_cast<const Curve*>(lua_touserdata(state, lua_upvalueindex(1)));
  if (lua_gettop(state) != 1)
    return luaL_error(state, "got %d arguments of a function of one variable, expected 1", lua_gettop(state));
  lua_pushnumber(state, curve_value(curve, luaL_checknumber(state, 1)));
  return 1;
}

}  // namespace

void add_curves(LuaState& lua, std::span<const std::string> names, std::span<const Curve> curves) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    lua_pushlightuserdata(lua.get(), const_cast<Curve*>(&curves[i]));
    lua_pushcclosure(lua.get(), lua_curve, 1);
    lua_setglobal(lua.get(), names[i].c_str());
  }
}

}  // namespace espalier::lsystem
