#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/curves.h>
#include <espalier/experiments/statistics/quantiles.h>

namespace espalier {

namespace {

std::vector<double> values_at(std::span<const StepCurve> curves, long evaluations) {
  std::vector<double> values;
  for (const StepCurve& curve : curves)
    if (const auto value = value_at(curve, evaluations)) values.push_back(*value);
  return values;
}

}  // namespace

void check_step_curve(const StepCurve& curve) {
  ESPALIER_CHECK_EQ(curve.evaluations.size(), curve.best.size());
  for (std::size_t i = 0; i < curve.best.size(); ++i) {
    const long before = i ? curve.evaluations[i - 1] : 0;
    ESPALIER_CHECK_EQ(curve.evaluations[i] > before, true);
    ESPALIER_CHECK_EQ(curve.best[i] >= curve.best[i ? i - 1 : 0], true);
  }
}

std::optional<double> value_at(const StepCurve& curve, long evaluations) {
  const auto& rows = curve.evaluations;
  const auto after = std::upper_bound(rows.begin(), rows.end(), evaluations);
  if (after == rows.begin()) return std::nullopt;
  return curve.best[static_cast<std::size_t>(after - rows.begin()) - 1];
}

std::vector<QuartileRow> quartile_curves(std::span<const StepCurve> curves, std::span<const long> grid) {
  for (const StepCurve& curve : curves) check_step_curve(curve);
  std::vector<QuartileRow> rows;
  for (const long evaluations : grid) {
    const std::vector<double> values = values_at(curves, evaluations);
    if (values.empty()) continue;
    rows.push_back(
        {evaluations, quantile(values, 0.25), median(values), quantile(values, 0.75), values.size()});
  }
  return rows;
}

std::vector<long> log_grid(long last, std::size_t points) {
  ESPALIER_CHECK_EQ(last >= 1 && points >= 2, true);
  std::vector<long> grid = {1};
  for (std::size_t i = 1; i < points; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(points - 1);
    const long next = std::lround(std::pow(static_cast<double>(last), share));
    if (next > grid.back()) grid.push_back(next);
  }
  return grid;
}

}  // namespace espalier
