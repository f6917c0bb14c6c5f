// A production made ready to run on blocks of modules: its expressions are programs or Lua functions, and
// its parameters are columns. A rule first finds which modules of a block it applies to, then computes the
// parameters of what replaces them.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <espalier/lsystem/derivation/context.h>
#include <espalier/lsystem/derivation/identities.h>
#include <espalier/lsystem/derivation/lua_curves.h>
#include <espalier/lsystem/derivation/lua_functions.h>
#include <espalier/lsystem/derivation/lua_surroundings.h>
#include <espalier/lsystem/strings/work.h>

namespace espalier::lsystem {

/// What all rules of a derivation share.
struct RuleContext {
  const Grammar& grammar;
  SymbolTable alphabet;
  LuaState lua;
  LuaFunctions functions;
  Work work;
  Surroundings surroundings;
  std::vector<double> globals;     ///< values of Names::globals
  std::vector<Curve> curves;       ///< of Names::curves
  std::uint32_t random_sites = 1;  ///< 0 is the choice between stochastic productions
  std::size_t expanded_bytes = 0;  ///< of let functions in all expressions
  std::size_t columns = 0;         ///< of all rules
  std::size_t expressions = 0;
  std::vector<std::uint32_t> matched;  ///< of the rule that looks at contexts now: a row a hit

  RuleContext(const Grammar& file, const Limits& limits)
      : grammar(file),
        alphabet(file.alphabet),
        lua(limits),
        functions(lua, file, alphabet),
        work(file.name, limits.work) {
    surroundings.set_work(work);
    curves.resize(file.functions.size());
    add_surroundings(lua, surroundings);
  }
};

/// An expression ready to be computed for a block of modules.
class BlockExpression {
 public:
  BlockExpression(const Expression& expression, std::span<const std::string> columns, bool is_condition,
                  RuleContext& shared);

  /// One value a module; of a condition 1 or 0. Throws InputError at the expression's place, naming `owner`
  /// and the module, where a value is no finite number.
  Column compute(std::span<const Column> columns, const RandomKey* keys, std::size_t count,
                 RuleContext& shared);

  const Expression& source() const { return *source_; }
  /// Whether it may call random().
  bool draws() const { return !program_ || program_->draws; }
  /// Columns of a block that it takes.
  std::size_t columns() const { return program_ ? program_->temporaries : 1; }
  /// Which value of the last computed column is no finite number, if any.
  static std::optional<std::size_t> first_not_finite(const Column& column, std::size_t count);

 private:
  const Expression* source_;
  std::optional<Program> program_;
  double operations_ = 0;  ///< of the program, on a module
  LuaState::Function function_ = 0;
  std::vector<double> scratch_;
};

/// Modules of a block that a rule may apply to: their places in the string and where their parameters start.
struct Candidates {
  std::vector<std::uint32_t> module, values;

  std::size_t size() const { return module.size(); }
  void clear() {
    module.clear();
    values.clear();
  }
};

/// A string that is being rewritten.
struct Rewriting {
  const ModuleString& string;
  const StringIndex& index;
  RandomKey key;                           ///< of the step
  const Identities* identities = nullptr;  ///< of modules: what keys are made of instead of their places

  RandomKey module_key(std::size_t module) const {
    return child_key(key, identities ? (*identities)[module] : module);
  }
};

class Rule {
 public:
  Rule(const Production& production, RuleContext& shared);

  const Production& production() const { return *production_; }
  /// Whether it may draw random numbers.
  bool draws() const { return needs_keys_ || probability_.has_value(); }

  /// Finds the candidates that fit contexts and condition: hits(), and for a stochastic rule weights().
  void match(const Candidates& candidates, const Rewriting& rewriting, RuleContext& shared);
  /// Positions among the candidates, ascending.
  const std::vector<std::uint16_t>& hits() const { return hits_; }
  const Column& weights() const { return weights_; }

  /// Keeps the hits for which `keep` holds and computes what replaces them.
  void keep_hits(std::span<const std::uint8_t> keep);
  void compute_successor(const Candidates& candidates, const Rewriting& rewriting, RuleContext& shared);

  /// How many modules and parameters replace hit `slot`.
  std::size_t symbol_count(std::size_t slot) const;
  std::size_t value_count(std::size_t slot) const;
  /// Writes them and moves both ends on.
  void write(std::size_t slot, SymbolId*& symbols, double*& values) const;
  /// False for a hit whose Lua body produced nothing: it stays as it is.
  bool replaces(std::size_t slot) const { return bodies_.empty() || bodies_[slot].produced; }

 private:
  struct Body {
    bool produced = false;
    std::uint32_t symbols_end = 0, values_end = 0;  ///< in produced_
  };

  void gather(const Candidates& candidates, const Rewriting& rewriting, const RuleContext& shared);
  void count_columns(RuleContext& shared) const;
  void match_contexts(const Candidates& candidates, const StringIndex& index, RuleContext& shared);
  void apply_condition(const Candidates& candidates, const Rewriting& rewriting, RuleContext& shared);
  void compress(std::span<const std::uint8_t> keep_by_slot);
  void make_keys(const Candidates& candidates, const Rewriting& rewriting);
  void run_bodies(const Candidates& candidates, const Rewriting& rewriting, RuleContext& shared);
  Column compute(BlockExpression& expression, const char* what, const Candidates& candidates,
                 const Rewriting& rewriting, RuleContext& shared);
  [[noreturn]] void fail(const Candidates& candidates, const Rewriting& rewriting, std::size_t slot,
                         const RuleContext& shared, const std::string& message) const;
  std::span<const Column> columns() const { return columns_; }

  const Production* production_;
  std::vector<std::string> parameters_;      ///< of left context, predecessor and right context
  std::size_t own_begin_ = 0, own_end_ = 0;  ///< columns of the predecessor's parameters
  std::vector<PatternModule> right_;
  std::optional<BlockExpression> condition_, probability_;
  std::vector<BlockExpression> arguments_;
  std::vector<int> argument_of_value_;  ///< index into arguments_, -1 for what the turtle will fill in
  std::vector<SymbolId> successor_;
  std::optional<LuaState::Function> body_;
  bool needs_keys_ = false;  ///< of random(), by module

  // Of the current block
  std::vector<std::uint16_t> hits_;
  std::vector<std::vector<double>> column_data_;
  std::vector<Column> columns_, results_;
  std::vector<RandomKey> keys_;
  std::vector<double> weight_data_;
  Column weights_;
  std::vector<Body> bodies_;
  ModuleString produced_;
};

}  // namespace espalier::lsystem
