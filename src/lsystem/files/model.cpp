#include <algorithm>
#include <mutex>
#include <optional>
#include <vector>

#include <espalier/lsystem/derivation/derivation.h>
#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/bundled.h>
#include <espalier/lsystem/files/model.h>
#include <espalier/overrides/reshape.h>

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
          .role = {Role::length_unit},
          .help = "metres of one unit of the L-system"};
}

/// Strings longer than this could not fit the budget of any plant: several modules make a stem or a leaf.
Limits limits_of(const GrowthBudget& budget) {
  Limits limits;
  limits.modules = static_cast<std::size_t>(
      std::clamp(20 * (budget.max_stems + budget.max_leaves), 1e4, static_cast<double>(limits.modules)));
  return limits;
}

/// Whether plants are asked for that differ from what the L-system grows.
bool is_reshaped(const GrowthSettings& growth) {
  return growth.only_part || (growth.changes && !growth.changes->empty());
}

/// A plant as the L-system grows it, kept for its next shape: branches are changed thousands of times on one.
struct GrownPlant {
  ParameterValues values;
  Seed seed = 0;
  GrowthBudget budget;
  int steps = kAllSteps;
  GrowthResult result;
  Reshaper reshaper;

  bool is_of(std::span<const double> other_values, Seed other_seed, const GrowthSettings& other) const {
    return seed == other_seed && steps == other.steps && budget.max_stems == other.budget.max_stems &&
           budget.max_leaves == other.budget.max_leaves && std::ranges::equal(values, other_values);
  }
};

/// What one thread at a time works with.
struct Worker {
  explicit Worker(const Grammar& grammar) : derivation(grammar) {}
  Derivation derivation;
  std::optional<GrownPlant> grown;  ///< without a volume to prune to
};

class LsystemModel : public Model {
 public:
  explicit LsystemModel(const std::string& name) : grammar_(load_grammar(name)), table_(grammar_.parameters) {
    Derivation derivation(grammar_);
    derivation.start(1);
    table_.rows.push_back(unit_row(derivation.settings().unit_m));
    table_.model = name;
  }

  const ParameterTable& table() const override { return table_; }

  std::vector<std::filesystem::path> files() const override { return grammar_.files; }

  /// Nothing is known before it is derived; the budget is kept while it is.
  GrowthEstimate estimate(std::span<const double>) const override { return {1, 0, false}; }

  bool has_branch_paths() const override { return true; }
  bool grows_in_steps() const override { return true; }
  /// Overrides act on what has grown: too late for other random numbers.
  bool can_change(Quantity quantity) const override { return quantity != Quantity::seed; }

  GrowthResult generate(std::span<const double> values, Seed seed, const GrowthSettings& growth,
                        Plant& plant) const override {
    if (growth.stem_cursors) growth.stem_cursors->clear();
    std::unique_ptr<Worker> worker = take_idle(values, seed, growth);
    GrowthResult result;
    try {
      if (is_reshaped(growth))
        result = grow_reshaped(*worker, values, seed, growth, plant);
      else
        result = grow(worker->derivation, values, seed, growth, plant, nullptr);
    } catch (const TooManyModules&) {
      result = {false, 2};
    }
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(worker));
    return result;
  }

 private:
  GrowthResult grow(Derivation& derivation, std::span<const double> values, Seed seed,
                    const GrowthSettings& growth, Plant& plant, PlantJoints* joints) const {
    derivation.set_limits(limits_of(growth.budget));
    prune(derivation, growth.prune_to, values.back());
    derivation.start(values.first(grammar_.parameters.rows.size()), seed);
    derivation.run(growth.steps == kAllSteps ? derivation.settings().steps : growth.steps);
    Settings settings = derivation.settings();
    settings.unit_m = values.back();
    const ModuleString& drawn = derivation.interpreted();
    build_plant(drawn, derivation.alphabet(), settings, plant, derivation.work(), joints);
    const double factor = std::max(static_cast<double>(plant.stems.size()) / growth.budget.max_stems,
                                   static_cast<double>(plant.leaves.size()) / growth.budget.max_leaves);
    return {factor <= 1, factor};
  }

  /// A volume may be another one at the same address: plants in a volume are not kept.
  GrowthResult grow_reshaped(Worker& worker, std::span<const double> values, Seed seed,
                             const GrowthSettings& growth, Plant& plant) const {
    std::optional<GrownPlant>& grown = worker.grown;
    if (growth.prune_to || !grown || !grown->is_of(values, seed, growth)) {
      grown.reset();
      JointedPlant base;
      const GrowthResult result = grow(worker.derivation, values, seed, growth, base.plant, &base.joints);
      if (!result.grown) return result;
      grown.emplace(GrownPlant{{values.begin(), values.end()},
                               seed,
                               growth.budget,
                               growth.steps,
                               result,
                               Reshaper(std::move(base))});
    }
    grown->reshaper.reshape(growth.changes, growth.only_part, plant, growth.stem_cursors);
    const GrowthResult result = grown->result;
    if (growth.prune_to) grown.reset();
    return result;
  }

  /// What plants are pruned to stands for the volume "clip" of the file.
  void prune(Derivation& derivation, const Volume* volume, double unit_m) const {
    constexpr const char* kClip = "clip";
    const auto& names = grammar_.names.volumes;
    if (!names.find(kClip)) {
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

  /// A worker that no other thread uses: derivations hold Lua states, which are no shared things. Which one
  /// it is makes no difference to the plant; one that has grown it before makes it faster.
  std::unique_ptr<Worker> take_idle(std::span<const double> values, Seed seed,
                                    const GrowthSettings& growth) const {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        auto chosen = std::find_if(idle_.begin(), idle_.end(), [&](const auto& worker) {
          return worker->grown && worker->grown->is_of(values, seed, growth);
        });
        if (chosen == idle_.end()) --chosen;
        std::unique_ptr<Worker> worker = std::move(*chosen);
        idle_.erase(chosen);
        return worker;
      }
    }
    return std::make_unique<Worker>(grammar_);
  }

  Grammar grammar_;
  ParameterTable table_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Worker>> idle_;
};

}  // namespace

std::unique_ptr<Model> make_model(const std::string& name_or_path) {
  return std::make_unique<LsystemModel>(name_or_path);
}

}  // namespace espalier::lsystem
