#include <cmath>
#include <lua.hpp>

#include <espalier/lsystem/derivation/lua_functions.h>
#include <espalier/lsystem/expressions/lua_usage.h>
#include <espalier/lsystem/strings/turtle_commands.h>
#include <espalier/lsystem/surfaces/surfaces.h>

namespace espalier::lsystem {

namespace {

constexpr double kPerDraw = 10, kPerModule = 30, kPerParameter = 6;

/// Of the arguments of produce(): at most one module for each letter.
double instructions_to_produce(lua_State* state) {
  double instructions = 0;
  for (int i = 1; i <= lua_gettop(state); ++i)
    instructions += lua_type(state, i) == LUA_TSTRING ? kPerModule * static_cast<double>(lua_objlen(state, i))
                                                      : kPerParameter;
  return instructions;
}

std::string joined(std::span<const std::string> names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

LuaFunctions::LuaFunctions(LuaState& lua, const Grammar& grammar, SymbolTable& alphabet)
    : lua_(lua), grammar_(grammar), alphabet_(alphabet) {
  add_function("random", lua_random);
  add_function("produce", lua_produce);
  add_function("at_module", lua_at);
  lua_State* state = lua_.get();
  lua_getglobal(state, "math");
  lua_getglobal(state, "random");
  lua_setfield(state, -2, "random");
  lua_pop(state, 1);
}

void LuaFunctions::add_function(const char* name, int (*function)(lua_State*)) {
  lua_pushlightuserdata(lua_.get(), this);
  lua_pushcclosure(lua_.get(), function, 1);
  lua_setglobal(lua_.get(), name);
}

void LuaFunctions::set_key(RandomKey key) {
  key_ = key;
  draws_ = 0;
}

/// random(): uniform in [0, 1); random(n) and random(m, n): a whole number from 1 or m to n, as math.random.
int LuaFunctions::lua_random(lua_State* state) {
  auto* self = static_cast<LuaFunctions*>(lua_touserdata(state, lua_upvalueindex(1)));
  charge_lua(state, kPerDraw);
  constexpr std::uint32_t kFirstSite = 1u << 30;  // far from the sites of programs
  const double u = random_unit(self->key_, kFirstSite + self->draws_++);
  const int arguments = lua_gettop(state);
  if (arguments == 0) {
    lua_pushnumber(state, u);
    return 1;
  }
  const double lower = arguments == 1 ? 1 : luaL_checknumber(state, 1),
               upper = luaL_checknumber(state, arguments);
  if (!(lower <= upper))
    return luaL_error(state, "random(%f, %f): expected the lower bound first", lower, upper);
  lua_pushnumber(state, std::floor(lower + u * (upper - lower + 1)));
  return 1;
}

/// at_module(i): what follows is computed for the i-th module of the block.
int LuaFunctions::lua_at(lua_State* state) {
  auto* self = static_cast<LuaFunctions*>(lua_touserdata(state, lua_upvalueindex(1)));
  const lua_Integer module = lua_tointeger(state, 1);
  if (module >= 1 && static_cast<std::size_t>(module) <= self->keys_.size())
    self->set_key(self->keys_[static_cast<std::size_t>(module) - 1]);
  return 0;
}

int LuaFunctions::lua_produce(lua_State* state) {
  auto* self = static_cast<LuaFunctions*>(lua_touserdata(state, lua_upvalueindex(1)));
  if (!self->out_) return luaL_error(state, "produce is for the bodies of productions");
  charge_lua(state, instructions_to_produce(state));
  try {
    self->produce(state);
    return 0;
  } catch (const std::exception& error) {
    lua_pushstring(state, error.what());
  }
  return lua_error(state);
}

void LuaFunctions::produce(lua_State* state) {
  produced_ = true;
  const int count = lua_gettop(state);
  for (int i = 1; i <= count;) {
    if (lua_type(state, i) != LUA_TSTRING)
      throw_input_error("produce: argument {} is a {}, expected the name of a module", i,
                        luaL_typename(state, i));
    const std::string_view text = lua_tostring(state, i++);
    const int first = i;
    if (text.ends_with('~') && i <= count && lua_type(state, i) == LUA_TSTRING)
      out_->values.push_back(surface_by_name(lua_tostring(state, i++), *grammar_.appearance));
    while (i <= count && lua_type(state, i) == LUA_TNUMBER) {
      const double value = lua_tonumber(state, i++);
      if (!std::isfinite(value))
        throw_input_error("produce: a parameter of {} is {}, expected a finite number", text, value);
      out_->values.push_back(value);
    }
    append_modules(text, static_cast<std::size_t>(i - first));
  }
}

void LuaFunctions::append_modules(std::string_view text, std::size_t arity) {
  while (!text.empty()) {
    const std::size_t length = symbol_length(text, grammar_.declared_symbols);
    if (out_->size() >= max_modules_)
      throw_input_error("produce: the string has more than {} modules, expected fewer", max_modules_);
    if (length == 0) throw_input_error("produce: got '{}', expected names of modules", text);
    const std::string_view name = text.substr(0, length);
    text.remove_prefix(length);
    if (name == "[") ++depth_;
    if (name == "]" && --depth_ < 0) throw_input_error("produce: got ']', expected a '[' before it");
    check_arity(name, text.empty() ? arity : 0);
    out_->symbols.push_back(alphabet_.intern(name, text.empty() ? arity : 0));
  }
}

void LuaFunctions::fill_table(std::size_t slot, const Column& column, std::size_t count) {
  lua_State* state = lua_.get();
  while (tables_.size() <= slot) {
    lua_createtable(state, static_cast<int>(kBlockSize), 0);
    tables_.push_back(luaL_ref(state, LUA_REGISTRYINDEX));
  }
  lua_rawgeti(state, LUA_REGISTRYINDEX, tables_[slot]);
  for (std::size_t i = 0; i < count; ++i) {
    lua_pushnumber(state, column[i]);
    lua_rawseti(state, -2, static_cast<int>(i + 1));
  }
}

LuaState::Function LuaFunctions::compile(const Expression& expression,
                                         std::span<const std::string> parameters, bool is_condition) {
  lua_.check_expression(expression.text, expression.position);
  std::string code = "return function(count__, results__";
  for (const std::string& name : parameters) code += ", column_" + name;
  code += ") for i__ = 1, count__ do ";
  if (expression.text.find("random") != std::string::npos) code += "at_module(i__) ";
  for (const std::string& name : parameters) code += fmt::format("local {0} = column_{0}[i__] ", name);
  code += "results__[i__] = (" + expression.text + "\n)" + (is_condition ? " and 1 or 0" : "") + " end end";
  return lua_.make_function(code, "expression");
}

void LuaFunctions::evaluate(LuaState::Function function, std::span<const Column> columns,
                            const RandomKey* keys, std::size_t count, double* results) {
  lua_State* state = lua_.get();
  keys_ = {keys, keys ? count : 0};
  lua_rawgeti(state, LUA_REGISTRYINDEX, function);
  lua_pushnumber(state, static_cast<double>(count));
  fill_table(0, {}, 0);
  for (std::size_t i = 0; i < columns.size(); ++i) fill_table(i + 1, columns[i], count);
  lua_.call(static_cast<int>(columns.size()) + 2, 0);
  lua_rawgeti(state, LUA_REGISTRYINDEX, tables_[0]);
  for (std::size_t i = 0; i < count; ++i) {
    lua_rawgeti(state, -1, static_cast<int>(i + 1));
    const bool is_number = lua_type(state, -1) == LUA_TNUMBER;
    const std::string type = is_number ? "" : luaL_typename(state, -1);
    results[i] = lua_tonumber(state, -1);
    lua_pop(state, 1);
    if (is_number) continue;
    lua_pop(state, 1);
    throw_input_error("got a {}, expected a number", type);
  }
  lua_pop(state, 1);
}

LuaState::Function LuaFunctions::compile_body(const Expression& body,
                                              std::span<const std::string> parameters) {
  const std::size_t code_start = body.text.find_first_not_of('\n');
  const std::string breaks = body.text.substr(0, code_start);
  const std::string label = body.position.source ? body.position.source->label : "L-system";
  lua_.check_code(body.text, label);  // alone, so that no error lies in the line of the "end" that is added
  return lua_.make_function(breaks + "return function(" + joined(parameters) + ") " +
                                (code_start == std::string::npos ? "" : body.text.substr(code_start)) +
                                "\nend",
                            label);
}

bool LuaFunctions::run_body(LuaState::Function function, std::span<const Column> columns, std::size_t module,
                            RandomKey key, ModuleString& out) {
  set_key(key);
  out_ = &out;
  produced_ = false;
  depth_ = 0;
  lua_rawgeti(lua_.get(), LUA_REGISTRYINDEX, function);
  for (const Column& column : columns) lua_pushnumber(lua_.get(), column[module]);
  try {
    lua_.call(static_cast<int>(columns.size()), 0);
  } catch (...) {
    out_ = nullptr;
    throw;
  }
  out_ = nullptr;
  if (depth_ != 0) throw_input_error("produce: got {} '[' without ']', expected none", depth_);
  return produced_;
}

}  // namespace espalier::lsystem
