#include <array>
#include <lua.hpp>

#include <espalier/lsystem/derivation/lua_surroundings.h>

namespace espalier::lsystem {

namespace {

/// Addresses that stand for volumes and fields; nothing is ever read there.
constexpr std::size_t kMost = 4096;
std::array<char, kMost> volume_addresses, field_addresses;

const Surroundings& self(lua_State* state) {
  return *static_cast<const Surroundings*>(lua_touserdata(state, lua_upvalueindex(1)));
}

/// The index of the first argument among `addresses`.
std::size_t object(lua_State* state, const std::array<char, kMost>& addresses, std::size_t count,
                   const char* what) {
  const auto* address = static_cast<const char*>(lua_touserdata(state, 1));
  const std::less<const char*> before;
  if (!address || before(address, addresses.data()) || !before(address, addresses.data() + count))
    luaL_error(state, "argument 1 is a %s, expected the name of a %s", luaL_typename(state, 1), what);
  return static_cast<std::size_t>(address - addresses.data());
}

Place place(lua_State* state, int first) {
  return {luaL_checknumber(state, first), luaL_checknumber(state, first + 1),
          luaL_checknumber(state, first + 2)};
}

std::size_t volume(lua_State* state) {
  return object(state, volume_addresses, self(state).volumes.size(), "volume");
}

int lua_inside(lua_State* state) {
  const std::size_t index = volume(state);
  lua_pushboolean(state, self(state).inside(index, place(state, 2)));
  return 1;
}

int lua_distance(lua_State* state) {
  const std::size_t index = volume(state);
  lua_pushnumber(state, self(state).distance(index, place(state, 2)));
  return 1;
}

int lua_value(lua_State* state) {
  const std::size_t index = object(state, field_addresses, self(state).fields.size(), "field");
  lua_pushnumber(state,
                 self(state).field(index, {luaL_checknumber(state, 2), luaL_checknumber(state, 3), 0}));
  return 1;
}

int lua_light(lua_State* state) {
  lua_pushnumber(state, self(state).light(0, place(state, 1)));
  return 1;
}

int lua_skylight(lua_State* state) {
  lua_pushnumber(state, self(state).skylight(0, place(state, 1)));
  return 1;
}

/// Exceptions become errors of Lua, through which they cannot pass.
template <lua_CFunction kFunction>
int guarded(lua_State* state) {
  try {
    return kFunction(state);
  } catch (const InputError& error) {
    lua_pushstring(state, error.what());
  }
  return lua_error(state);
}

}  // namespace

void add_surroundings(LuaState& lua, const Surroundings& surroundings) {
  constexpr std::array<std::pair<const char*, lua_CFunction>, 5> kFunctions{
      {{"inside", guarded<lua_inside>},
       {"distance", guarded<lua_distance>},
       {"value", guarded<lua_value>},
       {"light", guarded<lua_light>},
       {"skylight", guarded<lua_skylight>}}};
  for (const auto& [name, function] : kFunctions) {
    lua_pushlightuserdata(lua.get(), const_cast<Surroundings*>(&surroundings));
    lua_pushcclosure(lua.get(), function, 1);
    lua_setglobal(lua.get(), name);
  }
}

void name_surroundings(LuaState& lua, const Names& names) {
  for (std::size_t i = 0; i < names.volumes.size(); ++i) {
    lua_pushlightuserdata(lua.get(), &volume_addresses.at(i));
    lua_setglobal(lua.get(), names.volumes[i].c_str());
  }
  for (std::size_t i = 0; i < names.fields.size(); ++i) {
    lua_pushlightuserdata(lua.get(), &field_addresses.at(i));
    lua_setglobal(lua.get(), names.fields[i].c_str());
  }
}

}  // namespace espalier::lsystem
