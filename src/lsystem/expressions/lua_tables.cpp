#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <lua.hpp>

#include <espalier/lsystem/expressions/lua_tables.h>
#include <espalier/lsystem/expressions/lua_usage.h>

namespace espalier::lsystem {

namespace {

constexpr int kMostUnpacked = 1000;
constexpr double kPerKey = 4, kPerComparison = 10, kPerPiece = 60, kNumberToText = 60;

/// Going through a table passes its empty places too, which nobody can see.
void charge_traversal(lua_State* state) {
  charge_lua(state, 10 + static_cast<double>(usage_of(state).largest_block) / 16);
}

double length_of(lua_State* state, int index) {
  return lua_istable(state, index) ? static_cast<double>(lua_objlen(state, index)) : 0;
}

/// Calls Lua's own function, which is the upvalue, with what this one was called with.
int call_original(lua_State* state) {
  lua_pushvalue(state, lua_upvalueindex(1));
  lua_insert(state, 1);
  lua_call(state, lua_gettop(state) - 1, LUA_MULTRET);
  return lua_gettop(state);
}

int lua_insert_element(lua_State* state) {
  charge_lua(state, 1 + length_of(state, 1));
  return call_original(state);
}

/// table.remove(table, place): what was there, and those behind it move up.
int lua_remove_element(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  const int count = static_cast<int>(lua_objlen(state, 1)), place = luaL_optint(state, 2, count);
  if (place < 1 || place > count) return 0;
  charge_lua(state, 1 + kPerKey * (count - place));
  lua_rawgeti(state, 1, place);
  for (int i = place; i < count; ++i) {
    lua_rawgeti(state, 1, i + 1);
    lua_rawseti(state, 1, i);
  }
  lua_pushnil(state);
  lua_rawseti(state, 1, count);
  return 1;
}

int lua_maxn(lua_State* state) {
  charge_traversal(state);
  return call_original(state);
}

int lua_to_number(lua_State* state) {
  charge_string(state, 1);
  return call_original(state);
}

int lua_to_string(lua_State* state) {
  luaL_checkany(state, 1);
  const int type = lua_type(state, 1);
  if (type == LUA_TNUMBER) charge_lua(state, kNumberToText);
  if (type == LUA_TNUMBER || type == LUA_TSTRING || type == LUA_TBOOLEAN || type == LUA_TNIL)
    return call_original(state);
  lua_pushstring(state, lua_typename(state, type));
  return 1;
}

int lua_select(lua_State* state) {
  charge_lua(state, lua_gettop(state));
  return call_original(state);
}

int lua_unpack(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  const double first = luaL_optnumber(state, 2, 1), last = luaL_optnumber(state, 3, length_of(state, 1));
  const double count = last - first + 1;
  if (!(count > 0)) return 0;
  if (count > kMostUnpacked)
    return luaL_error(state, "unpack: got %f values, expected at most %d", count, kMostUnpacked);
  charge_lua(state, count);
  luaL_checkstack(state, static_cast<int>(count), "unpack");
  for (int i = 0; i < static_cast<int>(count); ++i) lua_rawgeti(state, 1, static_cast<int>(first) + i);
  return static_cast<int>(count);
}

int lua_table_concat(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  std::size_t between_length = 0, length = 0;
  const char* between = luaL_optlstring(state, 2, "", &between_length);
  const int first = luaL_optint(state, 3, 1),
            last = luaL_optint(state, 4, static_cast<int>(length_of(state, 1)));
  luaL_Buffer buffer;
  luaL_buffinit(state, &buffer);
  for (int i = first; i <= last; ++i) {
    if (i > first) luaL_addlstring(&buffer, between, between_length);
    lua_rawgeti(state, 1, i);
    if (!lua_isstring(state, -1))
      return luaL_error(state, "table.concat: value %d is a %s, expected a string or a number", i,
                        luaL_typename(state, -1));
    const std::size_t more = between_length + lua_objlen(state, -1);
    charge_lua(state, kPerPiece + static_cast<double>(more) / 8);
    charge_new_string(state, length += more);
    luaL_addvalue(&buffer);
    if (i == last) break;  // which may be the largest there is
  }
  luaL_pushresult(&buffer);
  return 1;
}

/// Whether a value on the stack comes before another one.
using Less = bool (*)(lua_State* state, int first, int second);

/// Whether element `i` of the table at `table` comes before element `j`.
bool is_before(lua_State* state, int table, int i, int j, Less less) {
  lua_rawgeti(state, table, i);
  lua_rawgeti(state, table, j);
  charge_lua(state, kPerComparison);
  charge_string(state, -1);
  const int top = lua_gettop(state);
  const bool before = less(state, top - 1, top);
  lua_settop(state, top - 2);
  return before;
}

void swap_elements(lua_State* state, int table, int i, int j) {
  lua_rawgeti(state, table, i);
  lua_rawgeti(state, table, j);
  lua_rawseti(state, table, i);
  lua_rawseti(state, table, j);
}

void sift_down(lua_State* state, int table, int root, int count, Less less) {
  for (int child = 2 * root; child <= count; root = child, child = 2 * root) {
    if (child < count && is_before(state, table, child, child + 1, less)) ++child;
    if (!is_before(state, table, root, child, less)) return;
    swap_elements(state, table, root, child);
  }
}

/// Heapsort: no order and no comparison makes it slower.
void sort_elements(lua_State* state, int table, int count, Less less) {
  for (int root = count / 2; root >= 1; --root) sift_down(state, table, root, count, less);
  for (int last = count; last > 1; --last) {
    swap_elements(state, table, 1, last);
    sift_down(state, table, 1, last - 1, less);
  }
}

bool is_less(lua_State* state, int first, int second) { return lua_lessthan(state, first, second) != 0; }

/// By the function that is the second argument.
bool is_less_by_function(lua_State* state, int first, int second) {
  lua_pushvalue(state, 2);
  lua_pushvalue(state, first);
  lua_pushvalue(state, second);
  lua_call(state, 2, 1);
  return lua_toboolean(state, -1) != 0;
}

int lua_sort(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  const bool has_function = !lua_isnoneornil(state, 2);
  if (has_function) luaL_checktype(state, 2, LUA_TFUNCTION);
  lua_settop(state, 2);
  luaL_checkstack(state, 10, "sort");
  sort_elements(state, 1, static_cast<int>(lua_objlen(state, 1)),
                has_function ? is_less_by_function : is_less);
  return 0;
}

int rank_of_key(lua_State* state, int index) {
  constexpr std::array kTypes{LUA_TNUMBER, LUA_TSTRING, LUA_TBOOLEAN};
  const auto* found = std::find(kTypes.begin(), kTypes.end(), lua_type(state, index));
  if (found == kTypes.end())
    luaL_error(state,
               "got a table with a key that is a %s, whose order is by chance; expected numbers and strings",
               luaL_typename(state, index));
  return static_cast<int>(found - kTypes.begin());
}

bool is_key_less(lua_State* state, int first, int second) {
  const int rank = rank_of_key(state, first), other = rank_of_key(state, second);
  if (rank != other) return rank < other;
  if (rank == 0) return lua_tonumber(state, first) < lua_tonumber(state, second);
  if (rank == 2) return lua_toboolean(state, first) < lua_toboolean(state, second);
  std::size_t length = 0, other_length = 0;
  const char* text = lua_tolstring(state, first, &length);
  const char* other_text = lua_tolstring(state, second, &other_length);
  const int order = std::memcmp(text, other_text, std::min(length, other_length));
  return order != 0 ? order < 0 : length < other_length;
}

/// next(table, key): the smallest key above that one, with its value.
int lua_next_key(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  lua_settop(state, 2);
  const bool is_first = lua_isnil(state, 2);
  charge_traversal(state);
  lua_pushnil(state);  // 3: the smallest so far
  lua_pushnil(state);
  while (lua_next(state, 1) != 0) {
    lua_pop(state, 1);
    charge_lua(state, kPerKey);
    const bool is_smaller = lua_isnil(state, 3) || is_key_less(state, 4, 3);
    if (is_smaller && (is_first || is_key_less(state, 2, 4))) {
      lua_pushvalue(state, 4);
      lua_replace(state, 3);
    }
  }
  lua_settop(state, 3);
  if (lua_isnil(state, 3)) return 1;
  lua_pushvalue(state, 3);
  lua_rawget(state, 1);
  return 2;
}

/// Upvalues: the sorted keys, and how many have been passed.
int lua_next_of_pairs(lua_State* state) {
  int passed = static_cast<int>(lua_tointeger(state, lua_upvalueindex(2)));
  for (;;) {
    lua_settop(state, 1);
    lua_rawgeti(state, lua_upvalueindex(1), ++passed);
    if (lua_isnil(state, 2)) return 1;
    lua_pushvalue(state, 2);
    lua_rawget(state, 1);
    if (!lua_isnil(state, 3)) break;  // what was taken away on the way is passed over
  }
  lua_pushinteger(state, passed);
  lua_replace(state, lua_upvalueindex(2));
  return 2;
}

int lua_pairs(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  lua_settop(state, 1);
  charge_traversal(state);
  lua_newtable(state);  // 2: the keys
  int count = 0;
  bool is_sorted = true;
  lua_pushnil(state);
  while (lua_next(state, 1) != 0) {
    lua_pop(state, 1);
    charge_lua(state, kPerKey);
    rank_of_key(state, 3);
    lua_pushvalue(state, 3);
    lua_rawseti(state, 2, ++count);
    is_sorted = is_sorted && (count == 1 || is_before(state, 2, count - 1, count, is_key_less));
  }
  if (!is_sorted) sort_elements(state, 2, count, is_key_less);
  lua_pushvalue(state, 2);
  lua_pushinteger(state, 0);
  lua_pushcclosure(state, lua_next_of_pairs, 2);
  lua_pushvalue(state, 1);
  lua_pushnil(state);
  return 3;
}

struct Replacement {
  const char* name;
  lua_CFunction function;
  bool calls_original = false;
};

/// In the table on top of the stack.
void replace_functions(lua_State* state, std::initializer_list<Replacement> replacements) {
  for (const auto& [name, function, calls_original] : replacements) {
    if (calls_original) lua_getfield(state, -1, name);
    lua_pushcclosure(state, function, calls_original ? 1 : 0);
    lua_setfield(state, -2, name);
  }
}

}  // namespace

void replace_table_functions(lua_State* state) {
  lua_pushvalue(state, LUA_GLOBALSINDEX);
  replace_functions(state, {{"next", lua_next_key},
                            {"pairs", lua_pairs},
                            {"unpack", lua_unpack},
                            {"tonumber", lua_to_number, true},
                            {"tostring", lua_to_string, true},
                            {"select", lua_select, true}});
  lua_getfield(state, -1, LUA_TABLIBNAME);
  replace_functions(state, {{"concat", lua_table_concat},
                            {"sort", lua_sort},
                            {"insert", lua_insert_element, true},
                            {"remove", lua_remove_element},
                            {"maxn", lua_maxn, true}});
  for (const char* name : {"foreach", "foreachi"}) {  // in an order by chance
    lua_pushnil(state);
    lua_setfield(state, -2, name);
  }
  lua_pop(state, 2);
}

}  // namespace espalier::lsystem
