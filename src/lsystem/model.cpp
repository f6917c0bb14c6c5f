#include "lsystem/model.h"

#include <algorithm>
#include <map>

#include "lsystem/bundled.h"
#include "lsystem/derivation.h"
#include "lsystem/plant_builder.h"

namespace espalier::lsystem {

namespace {

/// The row that every L-system has besides its own: how large its unit is. Starts of a fit are scaled by it.
ParameterInfo unit_row(double unit_m) {
  return {.name = "unit",
          .unit = "m",
          .lower = unit_m / 1000,
          .upper = unit_m * 1000,
          .search_lower = unit_m / 1000,
          .search_upper = unit_m * 1000,
          .scale = Scale::logarithmic,
          .default_value = unit_m,
          .help = "metres of one unit of the L-system"};
}

/// Strings longer than this could not fit the budget of any plant: several modules make a stem or a leaf.
Limits limits_of(const GrowthBudget& budget) {
  Limits limits;
  limits.modules = static_cast<std::size_t>(
      std::clamp(20 * (budget.max_stems + budget.max_leaves), 1e4, static_cast<double>(limits.modules)));
  return limits;
}

class LsystemModel : public Model {
 public:
  explicit LsystemModel(const std::string& name) : grammar_(load_grammar(name)), table_(grammar_.parameters) {
    Derivation derivation(grammar_);
    derivation.start(1);
    table_.rows.push_back(unit_row(derivation.settings().unit_m));
    table_.model = name;
  }

  const ParameterTable& table() const override { return table_; }

  /// Nothing is known before it is derived; the budget is kept while it is.
  GrowthEstimate estimate(std::span<const double>) const override { return {1, 0}; }

  GrowthResult generate(std::span<const double> values, Seed seed, const GrowthSettings& growth,
                        Plant& plant) const override {
    // One derivation a thread and model: a Lua state is no shared thing. Models live as long as the program.
    thread_local std::map<const LsystemModel*, std::unique_ptr<Derivation>> derivations;
    std::unique_ptr<Derivation>& derivation = derivations[this];
    if (!derivation) derivation = std::make_unique<Derivation>(grammar_);
    try {
      derivation->set_limits(limits_of(growth.budget));
      derivation->start(values.first(grammar_.parameters.rows.size()), seed);
      derivation->run(derivation->settings().steps);
      Settings settings = derivation->settings();
      settings.unit_m = values.back();
      build_plant(derivation->interpreted(), derivation->alphabet(), settings, plant);
    } catch (const TooManyModules&) {
      return {false, 2};
    }
    const double factor = std::max(static_cast<double>(plant.stems.size()) / growth.budget.max_stems,
                                   static_cast<double>(plant.leaves.size()) / growth.budget.max_leaves);
    return {factor <= 1, factor};
  }

 private:
  Grammar grammar_;
  ParameterTable table_;
};

}  // namespace

std::unique_ptr<Model> make_model(const std::string& name_or_path) {
  return std::make_unique<LsystemModel>(name_or_path);
}

}  // namespace espalier::lsystem
