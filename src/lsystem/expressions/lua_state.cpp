#include <array>
#include <cmath>
#include <cstdlib>
#include <lua.hpp>

#include <espalier/lsystem/expressions/lua_state.h>

namespace espalier::lsystem {

struct LuaState::Usage {
  Limits limits;
  std::size_t bytes = 0;
  double instructions = 0;
  bool sealed = false;
};

namespace {

constexpr int kInstructionsPerCheck = 1000;

/// An allocator that refuses what goes beyond the limit; Lua then raises "not enough memory".
template <typename Usage>
void* allocate(void* data, void* block, std::size_t old_size, std::size_t new_size) {
  auto* usage = static_cast<Usage*>(data);
  if (new_size == 0) {
    usage->bytes -= old_size;
    std::free(block);
    return nullptr;
  }
  const std::size_t bytes = usage->bytes - old_size + new_size;
  if (new_size > old_size && bytes > usage->limits.lua_memory_bytes) return nullptr;
  void* moved = std::realloc(block, new_size);
  if (moved) usage->bytes = bytes;
  return moved;
}

template <typename Usage>
void count_instructions(lua_State* state, lua_Debug* where) {
  void* data = nullptr;
  lua_getallocf(state, &data);
  auto* usage = static_cast<Usage*>(data);
  usage->instructions += kInstructionsPerCheck;
  if (usage->instructions <= usage->limits.lua_instructions) return;
  lua_getinfo(state, "Sl", where);
  luaL_error(state, "%s:%d: Lua ran for more than %d instructions, expected it to end sooner",
             where->short_src, where->currentline, static_cast<int>(usage->limits.lua_instructions));
}

/// Assigning to a global variable that is not there.
template <typename Usage>
int assign_new_global(lua_State* state) {
  void* data = nullptr;
  lua_getallocf(state, &data);
  if (static_cast<Usage*>(data)->sealed)
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

LuaState::LuaState(const Limits& limits) : usage_(std::make_unique<Usage>(Usage{limits})) {
  state_ = lua_newstate(allocate<Usage>, usage_.get());
  if (!state_) throw InternalError("LuaJIT gave no state");
  if (lua_cpcall(
          state_, [](lua_State* state) { return open_libraries(state); }, nullptr) != 0)
    throw InternalError("LuaJIT: " + take_message(state_));
  lua_createtable(state_, 0, 1);
  lua_pushcfunction(state_, assign_new_global<Usage>);
  lua_setfield(state_, -2, "__newindex");
  lua_setmetatable(state_, LUA_GLOBALSINDEX);
  lua_sethook(state_, count_instructions<Usage>, LUA_MASKCOUNT, kInstructionsPerCheck);
}

LuaState::~LuaState() { lua_close(state_); }

void LuaState::call(int arguments, int results) {
  if (lua_pcall(state_, arguments, results, 0) != 0) throw InputError(take_message(state_));
}

void LuaState::run(const std::string& code, const std::string& label) {
  const std::string name = "=" + label;
  if (luaL_loadbufferx(state_, code.data(), code.size(), name.c_str(), "t") != 0)
    throw InputError(take_message(state_));
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
  const std::string name = "=" + label;
  if (luaL_loadbufferx(state_, code.data(), code.size(), name.c_str(), "t") != 0)
    throw InputError(take_message(state_));
  call(0, 1);
  return luaL_ref(state_, LUA_REGISTRYINDEX);
}

void LuaState::check_code(const std::string& code, const std::string& label) {
  const std::string name = "=" + label;
  const int status = luaL_loadbufferx(state_, code.data(), code.size(), name.c_str(), "t");
  if (status != 0) throw InputError(take_message(state_));
  lua_pop(state_, 1);
}

void LuaState::check_expression(const std::string& expression, const Position& position) {
  // The line break ends a comment, so that it cannot hide the bracket.
  const std::string code = "return (" + expression + "\n)";
  const int status = luaL_loadbufferx(state_, code.data(), code.size(), "=expression", "t");
  if (status == 0) {
    lua_pop(state_, 1);
    return;
  }
  std::string message = take_message(state_);
  message = message.substr(message.find(": ") + 2);
  throw_at(position, "'{}': {}, expected a Lua expression", expression, message);
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

void LuaState::reset_instructions() { usage_->instructions = 0; }

}  // namespace espalier::lsystem
