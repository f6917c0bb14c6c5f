// Lua for the code of L-system files, shut in: mathematics, tables and a few pure functions, but no io, os,
// package, debug, ffi, coroutines, strings' methods, loading of code or catching of errors. Instructions and
// memory are limited, and what takes longer counts for more instructions (lua_usage.h). LuaJIT's compiler is
// off: compiled loops cannot be interrupted, so that `while true do end` would never end; what must be fast
// is a Program (program.h).
#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <espalier/lsystem/strings/limits.h>
#include <espalier/lsystem/strings/source.h>

struct lua_State;

namespace espalier::lsystem {

struct LuaUsage;  // lua_usage.h

class LuaState {
 public:
  explicit LuaState(const Limits& limits);
  ~LuaState();
  LuaState(const LuaState&) = delete;
  LuaState& operator=(const LuaState&) = delete;

  /// A compiled Lua function; valid as long as the state.
  using Function = int;

  /// Runs the code of a file. Throws InputError with Lua's message, which names file and line.
  void run(const std::string& code, const std::string& label);
  /// The function that running `code` returns, kept. Throws as run() does.
  Function make_function(const std::string& code, const std::string& label);
  /// Throws InputError with Lua's message unless `code` is Lua; runs nothing.
  void check_code(const std::string& code, const std::string& label);
  /// Throws InputError at `position` unless `expression` is one Lua expression.
  void check_expression(const std::string& expression, const Position& position);

  void set_global(const std::string& name, double value);
  bool has_global(const std::string& name);
  /// Calls the global function `name` with these numbers if it is there.
  void call_hook(const std::string& name, std::span<const double> arguments);
  /// Calls what lies on the stack: a function and `arguments` values, of which `results` are left.
  /// Throws InputError with Lua's message.
  void call(int arguments, int results);
  /// While sealed, code cannot make new global variables: what it changes is then what run() makes anew.
  void seal(bool sealed);
  double instructions() const;
  /// Starts counting instructions anew.
  void reset_instructions();

  lua_State* get() { return state_; }

 private:
  void call_as(const std::string& label, int arguments);
  void load(const std::string& code, const std::string& label);

  std::unique_ptr<LuaUsage> usage_;
  lua_State* state_ = nullptr;
};

}  // namespace espalier::lsystem
