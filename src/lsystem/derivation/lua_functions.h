// The Lua functions of an L-system: expressions over blocks of modules, one call for many modules, and the
// bodies of productions, which append modules by produce("F", length, "[", "A", age + 1, "]"): names, each
// followed by the parameters of its last module, of which that of a surface is its name: produce("~", "leaf",
// 1). random() is keyed by the step and the module.
#pragma once
#include <span>
#include <string>
#include <vector>

#include <espalier/lsystem/expressions/lua_state.h>
#include <espalier/lsystem/notation/grammar.h>
#include <espalier/lsystem/strings/module_string.h>

namespace espalier::lsystem {

class LuaFunctions {
 public:
  /// `alphabet` gets the symbols that bodies produce.
  LuaFunctions(LuaState& lua, const Grammar& grammar, SymbolTable& alphabet);
  LuaFunctions(const LuaFunctions&) = delete;
  LuaFunctions& operator=(const LuaFunctions&) = delete;

  /// A function that computes the expression for a block of modules with these parameters.
  LuaState::Function compile(const Expression& expression, std::span<const std::string> parameters,
                             bool is_condition);
  /// Computes it into `results`. Throws InputError with Lua's message, or where a result is no number.
  void evaluate(LuaState::Function function, std::span<const Column> columns, const RandomKey* keys,
                std::size_t count, double* results);

  LuaState::Function compile_body(const Expression& body, std::span<const std::string> parameters);
  /// Runs a body for one module; false where it never called produce.
  bool run_body(LuaState::Function function, std::span<const Column> columns, std::size_t module,
                RandomKey key, ModuleString& out);

  /// Bodies may not produce more than this for a block.
  void set_max_modules(std::size_t modules) { max_modules_ = modules; }

  /// What random() draws from until the next evaluation.
  void set_key(RandomKey key);

 private:
  static int lua_random(lua_State* state);
  static int lua_produce(lua_State* state);
  static int lua_at(lua_State* state);
  void produce(lua_State* state);
  void append_modules(std::string_view text, std::size_t arity);
  void add_function(const char* name, int (*function)(lua_State*));
  void fill_table(std::size_t slot, const Column& column, std::size_t count);

  LuaState& lua_;
  const Grammar& grammar_;
  SymbolTable& alphabet_;
  std::vector<int> tables_;  ///< Lua tables for columns, by slot
  RandomKey key_;
  std::uint32_t draws_ = 0;
  std::span<const RandomKey> keys_;
  ModuleString* out_ = nullptr;
  bool produced_ = false;
  int depth_ = 0;
  std::size_t max_modules_ = Limits{}.modules;
};

}  // namespace espalier::lsystem
