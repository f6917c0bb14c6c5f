#include <algorithm>
#include <array>
#include <lua.hpp>
#include <utility>

#include <espalier/lsystem/expressions/lua_state.h>
#include <espalier/lsystem/expressions/lua_tables.h>
#include <espalier/lsystem/expressions/lua_usage.h>

namespace espalier::lsystem {

namespace {

constexpr int kInstructionsPerCheck = 1000;

void count_instructions(lua_State* state, lua_Debug*) { charge_instructions(state, kInstructionsPerCheck); }

/// Assigning to a global variable that is not there.
int assign_new_global(lua_State* state) {
  if (usage_of(state).sealed)
    return luaL_error(state,
                      "got the new global variable '%s', expected 'local', or a first value in the lua: code",
                      lua_tostring(state, 2));
  lua_rawset(state, 1);
  return 0;
}

void open_library(lua_State* state, lua_CFunction open, const char* name) {
  lua_pushcfunction(state, open);
  lua_pushstring(state, name);
  lua_call(state, 1, 0);
}

void remove_global(lua_State* state, const char* name) {
  lua_pushnil(state);
  lua_setglobal(state, name);
}

/// All that could reach beyond the file, hide an error, or run for long inside one instruction.
constexpr std::array kRemoved{
    "dofile",   "loadfile",       "load",         "loadstring", "require", "module",  "package", "pcall",
    "xpcall",   "collectgarbage", "newproxy",     "print",      "getfenv", "setfenv", "rawset",  "rawget",
    "rawequal", "getmetatable",   "setmetatable", "coroutine",  "gcinfo",  "_VERSION"};

/// Functions of mathematics by their bare names, as in the papers.
constexpr std::array kBareMath{"abs", "floor", "ceil", "sqrt", "sin", "cos",
                               "tan", "exp",   "log",  "min",  "max"};

int open_libraries(lua_State* state) {
  open_library(state, luaopen_base, "");
  open_library(state, luaopen_math, LUA_MATHLIBNAME);
  open_library(state, luaopen_table, LUA_TABLIBNAME);
  for (const char* name : kRemoved) remove_global(state, name);
  lua_getglobal(state, "math");
  for (const char* name : kBareMath) {
    lua_getfield(state, -1, name);
    lua_setglobal(state, name);
  }
  for (const char* name : {"random", "randomseed"}) {
    lua_pushnil(state);
    lua_setfield(state, -2, name);
  }
  replace_table_functions(state);
  lua_pushliteral(state, "makes the buffer of strings, ");
  lua_pushliteral(state, "whose size is watched from now on");
  lua_concat(state, 2);
  lua_pop(state, 1);
  luaJIT_setmode(state, 0, LUAJIT_MODE_ENGINE | LUAJIT_MODE_OFF);
  return 0;
}

/// Lua's message on the stack, taken off it.
std::string take_message(lua_State* state) {
  const char* text = lua_tostring(state, -1);
  std::string message = text ? text : "an error that is no text";
  lua_pop(state, 1);
  for (char& c : message)
    if (c == '\n') c = ' ';
  return message;
}

}  // namespace

LuaState::LuaState(const Limits& limits) : usage_(std::make_unique<LuaUsage>(LuaUsage{limits})) {
  state_ = lua_newstate(allocate_lua, usage_.get());
  if (!state_) throw InternalError("LuaJIT gave no state");
  if (lua_cpcall(
          state_, [](lua_State* state) { return open_libraries(state); }, nullptr) != 0)
    throw InternalError("LuaJIT: " + take_message(state_));
  lua_createtable(state_, 0, 1);
  lua_pushcfunction(state_, assign_new_global);
  lua_setfield(state_, -2, "__newindex");
  lua_setmetatable(state_, LUA_GLOBALSINDEX);
  lua_sethook(state_, count_instructions, LUA_MASKCOUNT, kInstructionsPerCheck);
}

LuaState::~LuaState() { lua_close(state_); }

void LuaState::call(int arguments, int results) {
  const bool outer = std::exchange(usage_->is_running, true);
  const int status = lua_pcall(state_, arguments, results, 0);
  usage_->is_running = outer;
  usage_->is_ending = false;
  if (status == 0) return;
  const std::string message = take_message(state_);
  if (status == LUA_ERRMEM && usage_->is_over())
    throw_input_error("Lua ran for more than {} instructions, expected it to end sooner",
                      usage_->limits.lua_instructions);
  if (status == LUA_ERRMEM)
    throw_input_error("{}, expected Lua to need at most {} MB, and strings of 1 MB", message,
                      usage_->limits.lua_memory_bytes >> 20);
  throw InputError(message);
}

/// Compiles the code to a function on the stack.
void LuaState::load(const std::string& code, const std::string& label) {
  usage_->literal_instructions = std::max(usage_->literal_instructions, literal_instructions(code));
  const std::string name = "=" + label;
  usage_->is_loading = true;
  const int status = luaL_loadbufferx(state_, code.data(), code.size(), name.c_str(), "t");
  usage_->is_loading = false;
  if (status != 0) throw InputError(take_message(state_));
}

void LuaState::run(const std::string& code, const std::string& label) {
  load(code, label);
  call_as(label, 0);
}

/// Some errors of Lua, of its memory or its stack, come without a place.
void LuaState::call_as(const std::string& label, int arguments) {
  try {
    call(arguments, 0);
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.find(':') != std::string::npos) throw;
    throw_input_error("{}: {}", label, message);
  }
}

LuaState::Function LuaState::make_function(const std::string& code, const std::string& label) {
  load(code, label);
  call(0, 1);
  return luaL_ref(state_, LUA_REGISTRYINDEX);
}

void LuaState::check_code(const std::string& code, const std::string& label) {
  load(code, label);
  lua_pop(state_, 1);
}

void LuaState::check_expression(const std::string& expression, const Position& position) {
  try {
    // The line break ends a comment, so that it cannot hide the bracket.
    check_code("return (" + expression + "\n)", "expression");
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    throw_at(position, "'{}': {}, expected a Lua expression", shortened(expression),
             message.substr(message.find(": ") + 2));
  }
}

void LuaState::set_global(const std::string& name, double value) {
  lua_pushnumber(state_, value);
  lua_setglobal(state_, name.c_str());
}

bool LuaState::has_global(const std::string& name) {
  lua_getglobal(state_, name.c_str());
  const bool is_there = !lua_isnil(state_, -1);
  lua_pop(state_, 1);
  return is_there;
}

void LuaState::call_hook(const std::string& name, std::span<const double> arguments) {
  lua_getglobal(state_, name.c_str());
  if (!lua_isfunction(state_, -1)) {
    lua_pop(state_, 1);
    return;
  }
  for (const double value : arguments) lua_pushnumber(state_, value);
  call_as(name, static_cast<int>(arguments.size()));
}

void LuaState::seal(bool sealed) { usage_->sealed = sealed; }

double LuaState::instructions() const { return usage_->instructions; }

/// The buffer of strings halves with each collection of garbage: a derivation does not pay for the strings of
/// the one before.
void LuaState::reset_instructions() {
  constexpr std::size_t kSmallBuffer = 64;
  constexpr int kMostHalvings = 20;
  for (int i = 0; i < kMostHalvings && usage_->buffer_bytes > kSmallBuffer; ++i)
    lua_gc(state_, LUA_GCCOLLECT, 0);
  usage_->instructions = 0;
  usage_->longest_buffer = usage_->buffer_bytes;
  usage_->largest_block = 0;
}

}  // namespace espalier::lsystem
