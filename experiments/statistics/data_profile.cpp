#include <algorithm>
#include <cmath>
#include <map>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/data_profile.h>
#include <espalier/experiments/statistics/quantiles.h>

namespace espalier {

namespace {

/// The evaluations at which an optimiser reached its levels, sorted, out of how many.
struct Reached {
  std::string optimizer;
  std::vector<long> evaluations;
  std::size_t levels = 0;
};

double first_value(const StepCurve& curve, long evaluations) {
  return value_at(curve, evaluations).value_or(curve.best.front());
}

std::map<std::string, std::vector<double>> levels_by_target(std::span<const ProfileRun> runs,
                                                            const LevelSettings& settings) {
  std::map<std::string, std::vector<StepCurve>> curves;
  for (const ProfileRun& run : runs) curves[run.target].push_back(run.curve);
  std::map<std::string, std::vector<double>> levels;
  for (const auto& [target, of_target] : curves) levels[target] = fitness_levels(of_target, settings);
  return levels;
}

void add_reached(Reached& reached, const StepCurve& curve, std::span<const double> levels) {
  reached.levels += levels.size();
  for (const double level : levels) {
    const auto row = std::lower_bound(curve.best.begin(), curve.best.end(), level);
    if (row != curve.best.end())
      reached.evaluations.push_back(curve.evaluations[static_cast<std::size_t>(row - curve.best.begin())]);
  }
}

std::vector<Reached> reached_by_optimizer(std::span<const ProfileRun> runs, const LevelSettings& settings) {
  const auto levels = levels_by_target(runs, settings);
  std::vector<Reached> all;
  for (const ProfileRun& run : runs) {
    auto reached =
        std::find_if(all.begin(), all.end(), [&](const Reached& r) { return r.optimizer == run.optimizer; });
    if (reached == all.end()) reached = all.insert(all.end(), {run.optimizer, {}, 0});
    add_reached(*reached, run.curve, levels.at(run.target));
  }
  for (Reached& reached : all) std::sort(reached.evaluations.begin(), reached.evaluations.end());
  return all;
}

double share_within(const Reached& reached, long evaluations) {
  const auto& sorted = reached.evaluations;
  const auto count = std::upper_bound(sorted.begin(), sorted.end(), evaluations) - sorted.begin();
  return reached.levels ? static_cast<double>(count) / static_cast<double>(reached.levels) : 0;
}

}  // namespace

std::vector<double> fitness_levels(std::span<const StepCurve> curves, const LevelSettings& settings) {
  ESPALIER_CHECK_EQ(settings.levels >= 2 && settings.smallest_gap > 0 && settings.smallest_gap < 1, true);
  std::vector<double> first, last;
  for (const StepCurve& curve : curves) {
    check_step_curve(curve);
    if (curve.best.empty()) continue;
    first.push_back(first_value(curve, settings.first_evaluations));
    last.push_back(curve.best.back());
  }
  if (last.empty()) return {};
  const double base = median(first), best = *std::max_element(last.begin(), last.end());
  std::vector<double> levels;
  for (std::size_t i = 0; i < settings.levels; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(settings.levels - 1);
    levels.push_back(best -
                     std::pow(settings.smallest_gap, share) * (best - base));  // Moré, Wild 2009, (2.2)
  }
  return levels;
}

std::vector<ProfileRow> data_profiles(std::span<const ProfileRun> runs, std::span<const long> grid,
                                      const LevelSettings& settings) {
  std::vector<ProfileRow> rows;
  for (const Reached& reached : reached_by_optimizer(runs, settings))
    for (const long evaluations : grid)
      rows.push_back({reached.optimizer, evaluations, share_within(reached, evaluations)});
  return rows;
}

}  // namespace espalier
