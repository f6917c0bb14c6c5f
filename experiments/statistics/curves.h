// What a run had reached after so many evaluations, and the quartiles of many runs. Fitness: higher is
// better. A curve is a step function: it keeps a value until the next row, and its last one for ever, so that
// a run that ended early (converged, or at its target) stays comparable with those that went on.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace espalier {

/// Row i: after evaluations[i] (strictly rising, positive) the best fitness so far is best[i] (never
/// falling). A failed run has no rows. Both columns have the same length.
struct StepCurve {
  std::vector<long> evaluations;
  std::vector<double> best;
};

/// Throws InternalError where a curve breaks what is said above.
void check_step_curve(const StepCurve& curve);

/// The best fitness after so many evaluations; nothing before the first row.
std::optional<double> value_at(const StepCurve& curve, long evaluations);

struct QuartileRow {
  long evaluations = 0;
  double q25 = 0, median = 0, q75 = 0;
  std::size_t curves = 0;  ///< that have a value here; the quartiles are over these
};

/// One row a point of the grid, without those where no curve has a value yet.
std::vector<QuartileRow> quartile_curves(std::span<const StepCurve> curves, std::span<const long> grid);

/// At most `points` distinct whole numbers from 1 to `last` (both among them), evenly spaced in their
/// logarithm as far as whole numbers can be. points >= 2 and last >= 1: InternalError otherwise.
std::vector<long> log_grid(long last, std::size_t points);

}  // namespace espalier
