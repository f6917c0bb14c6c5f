// Checks before a run, the run, and the result after it; small helpers of several methods.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <espalier/core/error.h>
#include <espalier/fitting/optimizers/search_method.h>

namespace espalier {

namespace {

const OptimizerSetting& find_setting(const std::string& optimizer, std::span<const OptimizerSetting> known,
                                     const std::string& name) {
  for (const OptimizerSetting& info : known)
    if (info.name == name) return info;
  if (known.empty())
    throw_input_error("{}: got setting {}, expected none: it has no settings", optimizer, name);
  std::vector<std::string> names;
  for (const OptimizerSetting& info : known) names.push_back(info.name);
  throw_input_error("{}: got unknown setting {}, expected one of: {}", optimizer, name,
                    fmt::join(names, ", "));
}

void check_setting(const std::string& optimizer, const OptimizerSetting& info, double value) {
  const bool whole_enough = !info.whole || value == std::floor(value);
  if (value >= info.lower && value <= info.upper && whole_enough) return;
  throw_input_error("{}: setting {}: got {}, expected a {}number from {} to {}", optimizer, info.name, value,
                    info.whole ? "whole " : "", info.lower, info.upper);
}

void check_dimension(const Optimizer& optimizer, std::size_t dimension) {
  if (dimension < optimizer.min_dimension())
    throw_input_error("{}: got {} free parameters, expected at least {}", optimizer.name(), dimension,
                      optimizer.min_dimension());
  if (dimension > optimizer.max_dimension())
    throw_input_error("{}: got {} free parameters, expected at most {}", optimizer.name(), dimension,
                      optimizer.max_dimension());
}

void check_start(const std::string& optimizer, std::span<const double> start, std::size_t dimension) {
  if (start.size() % dimension != 0)
    throw_input_error("{}: start: got {} coordinates, expected a multiple of {}", optimizer, start.size(),
                      dimension);
  for (double coordinate : start)
    if (!(coordinate >= 0 && coordinate <= 1))
      throw_input_error("{}: start: got coordinate {}, expected 0 to 1", optimizer, coordinate);
}

std::vector<RatedPoint> evaluate_starts(Evaluator& evaluator, std::span<const double> start) {
  std::vector<RatedPoint> starts;
  if (start.empty()) return starts;
  const std::span<const double> values = evaluator.evaluate(start);
  for (std::size_t i : ranked(values)) {
    const auto row = start.subspan(i * evaluator.dimension(), evaluator.dimension());
    starts.push_back({{row.begin(), row.end()}, values[i]});
  }
  return starts;
}

}  // namespace

MinimizeResult SearchMethod::minimize(const Objective& objective, const OptimizerSettings& settings,
                                      const Budget& budget, std::span<const double> start, Seed seed,
                                      Observer& observer) const {
  const std::vector<OptimizerSetting> known = this->settings();
  const OptimizerSettings complete = complete_settings(name(), known, settings);
  Evaluator evaluator(objective, budget, observer);
  check_dimension(*this, evaluator.dimension());
  check_start(name(), start, evaluator.dimension());
  try {
    const std::vector<RatedPoint> starts = evaluate_starts(evaluator, start);
    Search run{evaluator, complete, starts, root_key(seed)};
    search(run);
  } catch (const StopSearch& stop) {
    return evaluator.result(stop.reason);
  }
  return evaluator.result(StopReason::converged);
}

OptimizerSettings complete_settings(const std::string& optimizer, std::span<const OptimizerSetting> known,
                                    const OptimizerSettings& given) {
  OptimizerSettings complete;
  for (const OptimizerSetting& info : known) complete[info.name] = info.default_value;
  for (const auto& [name, value] : given) {
    check_setting(optimizer, find_setting(optimizer, known, name), value);
    complete[name] = value;
  }
  return complete;
}

std::vector<double> random_point(std::size_t dimension, RandomStream& draws) {
  std::vector<double> point(dimension);
  for (double& coordinate : point) coordinate = draws.uniform();
  return point;
}

double reflect_into_unit(double coordinate) {
  return std::fabs(std::remainder(coordinate, 2.0));  // a triangle wave: even, period 2
}

std::vector<std::size_t> ranked(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

}  // namespace espalier
