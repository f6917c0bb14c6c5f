#include <algorithm>
#include <array>

#include <espalier/lsystem/derivation/derivation.h>
#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/drawing/queries.h>

namespace espalier::lsystem {

namespace {

constexpr std::uint64_t kInterpretationPlace = 1u
                                               << 20;  // steps have smaller numbers: the same in all of them

/// The axiom as the successor of a module that stands alone: it is computed like any other.
std::vector<Production> axiom_production(const Grammar& grammar, SymbolId start) {
  Production production;
  production.name = "axiom";
  production.position = *grammar.axiom_position;
  production.predecessor.symbol = start;
  production.successor = grammar.axiom;
  return {production};
}

bool is_constant(const Grammar& grammar, std::string_view name) {
  return std::any_of(grammar.constants.begin(), grammar.constants.end(),
                     [&](const Constant& constant) { return constant.name == name; });
}

}  // namespace

Derivation::Derivation(const Grammar& grammar, const Limits& limits)
    : shared_(grammar, limits), limits_(limits) {
  const auto& names = grammar.names.globals;
  shared_.functions.set_max_modules(limits.modules);
  shared_.globals.assign(names.size(), 0);
  if (!is_constant(grammar, "fraction")) fraction_global_ = names.find("fraction");
  run_lua_code();
  for (const Constant& constant : grammar.constants) {
    ConstantValue value;
    value.global = *names.find(constant.name);
    value.parameter = constant.parameter;
    if (!constant.parameter)
      value.value.emplace(constant.value, std::span<const std::string>(), false, shared_);
    constants_.push_back(std::move(value));
  }
  for (const Setting& setting : grammar.settings) {
    setting_values_.push_back({&setting, {}});
    for (const Expression& value : setting.values)
      setting_values_.back().values.emplace_back(value, std::span<const std::string>(), false, shared_);
  }
  for (const ProductionTable& table : grammar.tables)
    table_conditions_.emplace_back(table.condition, std::span<const std::string>(), true, shared_);
  surroundings_.emplace(shared_);
  productions_.emplace(grammar.productions, shared_, limits);
  interpretations_.emplace(grammar.interpretations, shared_, limits, RandomSites::of_each_production);
  axiom_ = axiom_production(grammar, shared_.alphabet.intern("axiom", 0));
  axiom_rewriter_.emplace(axiom_, shared_, limits);
  for (const char* name : {"[", "]", "%"}) shared_.alphabet.intern(name, 0);
  own_symbols_ = shared_.alphabet.size();
}

/// Those that Lua code made: no derivation sees, or counts as work, what the one before did.
void Derivation::forget_symbols() {
  if (shared_.alphabet.size() == own_symbols_) return;
  shared_.alphabet.truncate(own_symbols_);
  for (auto* rewriter : {&productions_, &interpretations_, &axiom_rewriter_}) (*rewriter)->forget_symbols();
}

/// Variables of the code get their first values again, so that no derivation sees what the one before did.
/// Constants are zero until then.
void Derivation::run_lua_code() {
  shared_.lua.seal(false);
  for (const std::string& name : shared_.grammar.names.globals) shared_.lua.set_global(name, 0);
  name_surroundings(shared_.lua, shared_.grammar.names);
  add_curves(shared_.lua, shared_.grammar.names.curves, shared_.curves);
  for (const LuaCode& code : shared_.grammar.lua) {
    if (code.body) shared_.lua.check_expression(code.body->text, code.body->position);
    shared_.lua.run(code.text, code.label);
  }
  shared_.lua.seal(true);
}

void Derivation::set_limits(const Limits& limits) {
  limits_ = limits;
  shared_.work.set_limit(limits.work);
  shared_.functions.set_max_modules(limits.modules);
  for (auto* rewriter : {&productions_, &interpretations_, &axiom_rewriter_}) (*rewriter)->set_limits(limits);
}

double Derivation::evaluate(BlockExpression& expression) {
  const Position& position = expression.source().position;
  const RandomKey key = child_key(root_key(seed_), ~std::uint64_t{0});
  try {
    const Column column = expression.compute({}, &key, 1, shared_);
    if (!BlockExpression::first_not_finite(column, 1)) return column[0];
  } catch (const TooMuchWork&) {
    throw;
  } catch (const InputError& error) {
    throw_at(position, "'{}': {}", shortened(expression.source().text), error.what());
  }
  throw_at(position, "'{}' is no finite number, expected one", shortened(expression.source().text));
}

void Derivation::set_global(std::size_t global, double value) {
  shared_.globals[global] = value;
  shared_.lua.set_global(shared_.grammar.names.globals[global], value);
}

void Derivation::evaluate_settings() {
  settings_ = {};
  settings_.appearance = shared_.grammar.appearance;
  settings_.leafy_segments = shared_.grammar.leafy_segments.value_or(false);
  for (SettingValue& entry : setting_values_) {
    const NotationSetting& info = *find_setting(entry.setting->name);
    SettingValues values{};
    for (std::size_t i = 0; i < entry.values.size(); ++i) {
      values[i] = evaluate(entry.values[i]);
      if (!(values[i] >= info.lower && values[i] <= info.upper))
        throw_at(entry.setting->values[i].position, "setting '{}': got {}, expected {} to {}", info.name,
                 values[i], info.lower, info.upper);
    }
    info.assign(settings_, values);
  }
}

void Derivation::start(std::span<const double> parameters, Seed seed) {
  ESPALIER_CHECK_EQ(parameters.size(), shared_.grammar.parameters.rows.size());
  seed_ = seed;
  step_ = 0;
  has_ended_ = false;
  modules_written_ = 0;
  shared_.lua.reset_instructions();
  shared_.work.restart();
  forget_symbols();
  run_lua_code();
  make_curves(parameters);
  set_global(shared_.globals.size() - 1, 0);
  surroundings_->clear();
  const auto value_of = [&](BlockExpression& expression) { return evaluate(expression); };
  for (std::size_t i = 0; i < constants_.size(); ++i) {
    surroundings_->make_after(i, value_of);
    ConstantValue& constant = constants_[i];
    set_global(constant.global,
               constant.parameter ? parameters[*constant.parameter] : evaluate(*constant.value));
  }
  surroundings_->make_after(constants_.size(), value_of);
  shared_.lua.call_hook("on_start", {});
  evaluate_settings();
  write_axiom();
}

void Derivation::make_curves(std::span<const double> parameters) {
  for (std::size_t i = 0; i < shared_.curves.size(); ++i) {
    const FunctionDeclaration& function = shared_.grammar.functions[i];
    shared_.curves[i] = make_curve(
        function.first_parameter ? parameters.subspan(*function.first_parameter, function.numbers.size())
                                 : std::span(function.numbers));
  }
}

void Derivation::write_axiom() {
  string_.clear();
  string_.symbols.push_back(shared_.alphabet.intern("axiom", 0));
  identities_.clear();
  identities_.push_back(0);
  axiom_rewriter_->rewrite(string_, child_key(root_key(seed_), 0), {}, next_, lineage());
  finish_step();
}

/// Identities are for interpretation rules that draw random numbers only.
Lineage Derivation::lineage() {
  if (!interpretations_->draws()) return {};
  return {.string = &identities_, .result = &next_identities_, .step = static_cast<std::uint64_t>(step_)};
}

void Derivation::finish_step() {
  std::swap(string_, next_);
  std::swap(identities_, next_identities_);
  modules_written_ += string_.size();
  shared_.work.add(static_cast<double>(string_.size()));
  cut_branches();
  fill_queries();
  if (shared_.grammar.uses_light) update_light();
}

void Derivation::step() {
  if (step_ >= limits_.steps)
    throw_input_error("{}: got step {}, expected at most {} (a limit that can be set)", shared_.grammar.name,
                      step_ + 1, limits_.steps);
  ++step_;
  const double number = step_;
  set_global(shared_.globals.size() - 1, number);
  if (fraction_global_) set_global(*fraction_global_, 0);
  shared_.lua.call_hook("on_step", std::span(&number, 1));
  std::vector<bool> table_is_on;
  for (BlockExpression& condition : table_conditions_) table_is_on.push_back(evaluate(condition) != 0);
  productions_->rewrite(string_, child_key(root_key(seed_), static_cast<std::uint64_t>(step_)), table_is_on,
                        next_, lineage());
  finish_step();
}

void Derivation::advance(int steps) {
  while (step_ < steps) step();
}

void Derivation::run(int steps) {
  advance(steps);
  if (!has_ended_) shared_.lua.call_hook("on_end", {});
  has_ended_ = true;
}

/// Everything from a % to the end of its branch goes [Topiary §2].
void Derivation::cut_branches() {
  const SymbolId cut = shared_.alphabet.intern("%", 0);
  const SymbolId open = shared_.alphabet.intern("[", 0), close = shared_.alphabet.intern("]", 0);
  SymbolId* const begin = string_.symbols.data();
  SymbolId* const end = begin + string_.size();
  SymbolId* symbol = std::find(begin, end, cut);
  if (symbol == end) return;
  const auto& arities = shared_.alphabet.arities();
  SymbolId* kept = begin;
  double *value = string_.values.data(), *kept_value = value;
  const bool has_identities = interpretations_->draws();
  int cut_depth = 0;  // of branches inside the one that is being cut; 0 where nothing is
  for (symbol = begin; symbol < end; ++symbol) {
    const std::size_t arity = arities[*symbol];
    if (cut_depth == 0 && *symbol == cut)
      cut_depth = 1;
    else if (cut_depth > 0 && *symbol == open)
      ++cut_depth;
    else if (cut_depth > 0 && *symbol == close)
      --cut_depth;
    if (cut_depth == 0) {
      if (has_identities)
        identities_[static_cast<std::size_t>(kept - begin)] =
            identities_[static_cast<std::size_t>(symbol - begin)];
      *kept++ = *symbol;
      kept_value = std::copy_n(value, arity, kept_value);
    }
    value += arity;
  }
  string_.symbols.truncate(static_cast<std::size_t>(kept - begin));
  string_.values.truncate(static_cast<std::size_t>(kept_value - string_.values.data()));
  if (has_identities) identities_.truncate(string_.size());
}

const ModuleString& Derivation::interpreted(double fraction) {
  if (interpretations_->is_empty()) return string_;
  if (fraction_global_) set_global(*fraction_global_, fraction);
  const Lineage keyed{.keys = interpretations_->draws() ? &identities_ : nullptr};
  interpretations_->rewrite(string_, child_key(root_key(seed_), kInterpretationPlace),
                            std::vector<bool>(table_conditions_.size(), true), drawn_, keyed);
  return drawn_;
}

VolumePtr Derivation::volume(const std::string& name) const {
  const NameList& names = shared_.grammar.names.volumes;
  const auto found = names.find(name);
  if (!found)
    throw_input_error("{}: got volume '{}', expected {}", shared_.grammar.name, name,
                      names.empty() ? "none: the L-system declares no volumes"
                                    : fmt::format("one of: {}", fmt::join(names, ", ")));
  return shared_.surroundings.volumes[*found];
}

Vec3 Derivation::towards_sun() const {
  if (!shared_.grammar.has_sun) return {0, 0, 1};
  const NameList& names = shared_.grammar.names.globals;
  const auto of = [&](const char* name) { return static_cast<float>(shared_.globals[*names.find(name)]); };
  return {of("sun_x"), of("sun_y"), of("sun_z")};
}

/// The plant as it is now shades itself in the next step.
void Derivation::update_light() {
  constexpr double kGap = 0.3;  // of a segment
  shading_plant_.clear();
  build_plant(interpreted(), shared_.alphabet, settings_, shading_plant_, shared_.work);
  shared_.work.add(work_of::kInScene *
                   static_cast<double>(shading_plant_.knots.size() + shading_plant_.leaves.size()));
  shared_.surroundings.set_light(shading_plant_, settings_.unit_m, towards_sun(), kGap * settings_.length,
                                 shared_.grammar.shades);
}

void Derivation::fill_queries() {
  if (!has_queries(shared_.alphabet)) return;
  const ModuleString& drawn = interpreted();
  shared_.work.add(2 * work_of::kModule * static_cast<double>(drawn.size()) +
                   work_of::kSymbol * static_cast<double>(shared_.alphabet.size()));
  espalier::lsystem::fill_queries(drawn, string_, shared_.alphabet, settings_);
}

}  // namespace espalier::lsystem
