// What every optimiser shares. All of them minimise over the unit box [0, 1]^n and evaluate batches
// of candidates, so that one place counts, logs, replays, parallelises and stops.
#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <espalier/core/random.h>

namespace espalier {

/// A function to minimise over [0, 1]^dimension.
class Objective {
 public:
  virtual ~Objective() = default;
  virtual std::size_t dimension() const = 0;
  /// points: row-major, values.size() rows of dimension() coordinates in [0, 1]. Finite values out.
  /// Rows may be computed in parallel; value i depends on row i only.
  virtual void evaluate(std::span<const double> points, std::span<double> values) const = 0;

  /// The parameter that coordinate `unit` of dimension `index` stands for, in its own unit and with its
  /// own sign: what "proportional to its value" and "flip its sign" mean to hewitt_ga. A search space
  /// overrides both; a plain function of the box is its own parameter.
  virtual double value_of(std::size_t index, double unit) const {
    (void)index;
    return unit;
  }
  /// The coordinate in [0, 1] whose parameter lies closest to `value`; the inverse of value_of. A sign that
  /// has no coordinate (no negative values in the bounds) is thereby clamped away.
  virtual double unit_of(std::size_t index, double value) const {
    (void)index;
    return std::clamp(value, 0.0, 1.0);
  }
};

struct Budget {
  long evaluations = 5000;                                   ///< true evaluations; at least 1
  double target = -std::numeric_limits<double>::infinity();  ///< stop once a value is at or below it
};

/// Sees every batch in order, decides on early stops (time, Ctrl-C). Observers only log.
class Observer {
 public:
  virtual ~Observer() = default;
  /// first_evaluation: how many evaluations came before this batch.
  virtual void on_batch(long first_evaluation, std::span<const double> points,
                        std::span<const double> values) {
    (void)first_evaluation, (void)points, (void)values;
  }
  /// Asked before each batch; true ends the run there.
  virtual bool stop_requested() { return false; }
};

enum class StopReason { budget, target, observer, converged };

/// best_point is empty where the observer stopped the run before its first evaluation.
struct MinimizeResult {
  std::vector<double> best_point;
  double best_value = std::numeric_limits<double>::infinity();
  long evaluations = 0;
  StopReason stopped_by = StopReason::budget;
};

/// Settings of an optimiser by name: numbers only; an unknown name is an InputError that lists the known
/// ones.
using OptimizerSettings = std::map<std::string, double>;

struct OptimizerSetting {
  std::string name;
  double default_value, lower, upper;
  std::string help;
  bool whole = false;  ///< a count or a switch: whole numbers only
};

class Optimizer {
 public:
  virtual ~Optimizer() = default;
  virtual std::string name() const = 0;
  virtual std::string help() const = 0;  ///< one line: method and source
  virtual std::vector<OptimizerSetting> settings() const { return {}; }
  /// The dimensions the method can handle, both included; minimize throws InputError outside them.
  virtual std::size_t min_dimension() const { return 1; }
  virtual std::size_t max_dimension() const { return std::numeric_limits<std::size_t>::max(); }
  /// False where the method is deterministic: every seed then gives the same run.
  virtual bool uses_seed() const { return true; }
  /// Throws InputError where budget, start or settings do not suit the method, before any evaluation.
  /// start: points to begin from, rows of dimension coordinates in [0, 1], possibly none. They are evaluated
  /// first, in one batch, and count; methods without a start point (DIRECT) only remember the best.
  /// No method looks at the budget: a run with a smaller one is a prefix of the longer run.
  /// The same (objective, settings, budget, start, seed) gives the same bits, whatever the threads.
  virtual MinimizeResult minimize(const Objective& objective, const OptimizerSettings& settings,
                                  const Budget& budget, std::span<const double> start, Seed seed,
                                  Observer& observer) const = 0;
};

/// All optimisers, in the order of the help: those of methods.h, then NLopt's.
const std::vector<std::unique_ptr<Optimizer>>& all_optimizers();

/// Throws InputError naming the closest optimiser where there is none of this name.
const Optimizer& optimizer_by_name(const std::string& name);

}  // namespace espalier
