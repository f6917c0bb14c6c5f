#include "lsystem/model.h"

#include <algorithm>
#include <mutex>
#include <vector>

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
    std::unique_ptr<Derivation> derivation = take_idle();
    GrowthResult result;
    try {
      derivation->set_limits(limits_of(growth.budget));
      prune(*derivation, growth.prune_to, values.back());
      derivation->start(values.first(grammar_.parameters.rows.size()), seed);
      derivation->run(derivation->settings().steps);
      Settings settings = derivation->settings();
      settings.unit_m = values.back();
      build_plant(derivation->interpreted(), derivation->alphabet(), settings, plant);
      const double factor = std::max(static_cast<double>(plant.stems.size()) / growth.budget.max_stems,
                                     static_cast<double>(plant.leaves.size()) / growth.budget.max_leaves);
      result = {factor <= 1, factor};
    } catch (const TooManyModules&) {
      result = {false, 2};
    }
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(derivation));
    return result;
  }

 private:
  /// What plants are pruned to stands for the volume "clip" of the file.
  void prune(Derivation& derivation, const Volume* volume, double unit_m) const {
    constexpr const char* kClip = "clip";
    const auto& names = grammar_.names.volumes;
    if (std::find(names.begin(), names.end(), kClip) == names.end()) {
      if (volume)
        throw_input_error(
            "{}: got a volume to prune to, expected none: the L-system declares no volume 'clip'",
            table_.model);
      return;
    }
    derivation.replace_volume(
        kClip, volume ? make_scaled(static_cast<float>(1 / unit_m), VolumePtr(volume, [](const Volume*) {}))
                      : nullptr);
  }

  /// A derivation that no other thread uses: they hold Lua states, which are no shared things. Which one it
  /// is makes no difference to the plant.
  std::unique_ptr<Derivation> take_idle() const {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        std::unique_ptr<Derivation> derivation = std::move(idle_.back());
        idle_.pop_back();
        return derivation;
      }
    }
    return std::make_unique<Derivation>(grammar_);
  }

  Grammar grammar_;
  ParameterTable table_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Derivation>> idle_;
};

}  // namespace

std::unique_ptr<Model> make_model(const std::string& name_or_path) {
  return std::make_unique<LsystemModel>(name_or_path);
}

}  // namespace espalier::lsystem
