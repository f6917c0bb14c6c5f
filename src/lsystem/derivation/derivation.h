// The derivation of an L-system: from the axiom, one string a step. After each step the cut symbol % erases
// the rest of its branch, and the turtle fills the query modules ?P ?H ?U ?L [Topiary §3].
// Random numbers are keyed by seed, step and place in the string, those of interpretation rules by seed and
// identity of the module (identities.h): a derivation repeats bit for bit.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include <espalier/lsystem/derivation/place_surroundings.h>
#include <espalier/lsystem/derivation/rewriter.h>
#include <espalier/lsystem/notation/settings.h>
#include <espalier/lsystem/strings/limits.h>

namespace espalier::lsystem {

class Derivation {
 public:
  /// Compiles all expressions and runs the file's Lua code. Throws InputError with the place and what was
  /// expected. `grammar` must outlive the derivation.
  explicit Derivation(const Grammar& grammar, const Limits& limits = {});

  void set_limits(const Limits& limits);
  /// From the next start on, the volume of this name is `volume`, in units, whatever the file says; null: as
  /// the file says. Throws InputError where the file has no volume of that name.
  void replace_volume(const std::string& name, VolumePtr volume) {
    surroundings_->replace(name, std::move(volume));
  }
  /// Back to the axiom. `parameters` follow grammar.parameters.
  void start(std::span<const double> parameters, Seed seed);
  void start(Seed seed) { start(shared_.grammar.parameters.defaults(), seed); }
  /// One derivation step. Throws InputError where it fails, with the production and the module.
  void step();
  /// Steps until step_number() is `steps`: a stage of growth that goes on.
  void advance(int steps);
  /// The same, and then calls on_end() of the file's Lua code: these were all steps.
  void run(int steps);

  int step_number() const { return step_; }
  const ModuleString& string() const { return string_; }
  std::string text() const { return to_text(string_, shared_.alphabet); }
  const SymbolTable& alphabet() const { return shared_.alphabet; }
  const Settings& settings() const { return settings_; }
  /// The volume of this name in the derivation that was started last, in units. Throws InputError for none.
  VolumePtr volume(const std::string& name) const;
  /// The string as it is drawn: after the interpretation rules, in which `fraction` (0 to below 1) is how
  /// much of the time to the next step has passed. Valid until the next call.
  const ModuleString& interpreted(double fraction = 0);
  /// What the file's Lua code ran so far.
  double lua_instructions() const { return shared_.lua.instructions(); }
  /// Of this derivation so far, and its limit.
  Work& work() { return shared_.work; }
  /// Modules written by all steps so far.
  std::size_t modules_written() const { return modules_written_; }
  /// Memory of the current string and the one before it.
  std::size_t memory_bytes() const { return string_.memory_bytes() + next_.memory_bytes(); }

 private:
  struct ConstantValue {
    std::size_t global = 0;
    std::optional<std::size_t> parameter;
    std::optional<BlockExpression> value;
  };
  struct SettingValue {
    const Setting* setting = nullptr;
    std::vector<BlockExpression> values;
  };

  void run_lua_code();
  void forget_symbols();
  void make_curves(std::span<const double> parameters);
  double evaluate(BlockExpression& expression);
  void set_global(std::size_t global, double value);
  void evaluate_settings();
  void write_axiom();
  Lineage lineage();
  void finish_step();
  void cut_branches();
  void fill_queries();
  void update_light();
  Vec3 towards_sun() const;

  RuleContext shared_;
  Limits limits_;
  std::vector<ConstantValue> constants_;
  std::vector<SettingValue> setting_values_;
  std::optional<SurroundingsMaker> surroundings_;
  std::vector<BlockExpression> table_conditions_;
  std::optional<Rewriter> productions_, interpretations_;
  std::vector<Production> axiom_;  ///< one production whose successor is the axiom
  std::optional<Rewriter> axiom_rewriter_;
  ModuleString string_, next_, drawn_;
  Identities identities_, next_identities_;  ///< of string_ and next_, where interpretation rules draw
  Plant shading_plant_;
  std::optional<std::size_t> fraction_global_;  ///< none where the file has another meaning for the name
  Settings settings_;
  std::size_t own_symbols_ = 0;  ///< of the file, and not of what Lua code made of it
  Seed seed_ = 0;
  int step_ = 0;
  bool has_ended_ = false;
  std::size_t modules_written_ = 0;
};

}  // namespace espalier::lsystem
