// The Weber–Penn model behind the Model interface, see model.h.
#include <algorithm>

#include <espalier/weber_penn/deepen.h>
#include <espalier/weber_penn/estimate.h>
#include <espalier/weber_penn/grow.h>
#include <espalier/weber_penn/model.h>
#include <espalier/weber_penn/table/parameters.h>
#include <espalier/weber_penn/tree_crown.h>

namespace espalier {

namespace {

class WeberPennModel : public Model {
 public:
  const ParameterTable& table() const override { return weber_penn_table(); }

  ParameterValues deepened(std::span<const double> values, int levels) const override {
    return deepened_values(values, levels);
  }

  bool has_branch_paths() const override { return true; }
  bool has_branch_crowns() const override { return true; }
  bool uses_crown(std::span<const double> values) const override {
    return weber_penn_parameters(values).crown_use != 0;
  }
  void set_crown(const CrownShape& crown, ParameterValues& values) const override {
    set_crown_rows(crown, values);
  }
  bool can_train() const override { return true; }

  std::vector<std::string> palm_presets() const override { return {"palm", "fan_palm"}; }

  BranchLimits branch_limits(std::span<const double> values) const override {
    const WeberPennParameters p = weber_penn_parameters(values);
    return {p.level_count(), static_cast<std::uint32_t>(std::max(1.f, p.branches[0]))};
  }

  GrowthEstimate estimate(std::span<const double> values) const override {
    return estimate_growth(weber_penn_parameters(values));
  }

  GrowthResult generate(std::span<const double> values, Seed seed, const GrowthSettings& settings,
                        Plant& plant) const override {
    const WeberPennParameters parameters = weber_penn_parameters(values);
    const GrowthEstimate expected = estimate_growth(parameters);
    // Twice the budget is beyond the estimate's error: refused before it is grown.
    const double factor =
        std::max(expected.stems / settings.budget.max_stems, expected.leaves / settings.budget.max_leaves);
    if (factor > 2) return {false, factor};
    const BranchParameters of_branches(values, settings.changes);
    return grow_tree(parameters, seed, settings, plant, Lanes::many,
                     of_branches.empty() ? nullptr : &of_branches);
  }
};

}  // namespace

const Model& weber_penn_model() {
  static const WeberPennModel kModel;
  return kModel;
}

}  // namespace espalier
