// What every optimiser must do, whatever its method: one suite over all_optimizers().
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include <espalier/core/error.h>
#include <espalier/fitting/optimizers/optimizer.h>

#include "support/test_functions.h"

namespace espalier {
namespace {

using namespace test;

/// The dimension most laws are tested in: one that every optimiser takes.
constexpr std::size_t kDimension = 4;

class EveryOptimizer : public testing::TestWithParam<std::string> {
 protected:
  const Optimizer& optimizer() const { return optimizer_by_name(GetParam()); }

  /// Enough to see restarts; less for NEWUOA_BOUND, whose own steps take milliseconds.
  long evaluations() const { return GetParam().find("NEWUOA") == std::string::npos ? 600 : 120; }

  MinimizeResult run(const Objective& objective, long budget, Observer& observer, Seed seed = 1,
                     std::vector<double> start = {}) const {
    return optimizer().minimize(objective, {}, Budget{budget}, start, seed, observer);
  }
  Trace trace_of(const Objective& objective, long budget, Seed seed = 1) const {
    Trace trace;
    run(objective, budget, trace, seed);
    return trace;
  }
  void expect_rejected(const OptimizerSettings& settings, Budget budget, std::vector<double> start,
                       const std::string& part_of_message) const {
    const Sphere sphere(kDimension);
    Observer silent;
    try {
      optimizer().minimize(sphere, settings, budget, start, 1, silent);
      FAIL() << "accepted, expected a message with: " << part_of_message;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part_of_message), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
    EXPECT_EQ(sphere.count(), 0);
  }
};

void expect_prefix(const Trace& shorter, const Trace& longer) {
  ASSERT_LE(shorter.values.size(), longer.values.size());
  EXPECT_TRUE(std::equal(shorter.values.begin(), shorter.values.end(), longer.values.begin()));
  EXPECT_TRUE(std::equal(shorter.points.begin(), shorter.points.end(), longer.points.begin()));
}

TEST_P(EveryOptimizer, EvaluatesOnlyInsideTheBox) {
  const Trace trace = trace_of(Sphere(kDimension), evaluations());
  for (double coordinate : trace.points) ASSERT_TRUE(coordinate >= 0 && coordinate <= 1) << coordinate;
}

TEST_P(EveryOptimizer, CountsTrueEvaluationsAndSpendsTheBudget) {
  const Sphere sphere(kDimension);
  Trace trace;
  const MinimizeResult result = run(sphere, evaluations(), trace);
  EXPECT_EQ(result.evaluations, sphere.count());
  EXPECT_EQ(result.evaluations, static_cast<long>(trace.values.size()));
  EXPECT_EQ(result.evaluations, evaluations());
  EXPECT_EQ(result.stopped_by, StopReason::budget);
  EXPECT_TRUE(trace.in_order);
}

TEST_P(EveryOptimizer, ResultIsTheFirstBestOfTheTrace) {
  Trace trace;
  const MinimizeResult result = run(Staircase(kDimension), evaluations(), trace);
  const auto best = std::min_element(trace.values.begin(), trace.values.end());
  const auto row = trace.points.begin() + (best - trace.values.begin()) * long{kDimension};
  EXPECT_EQ(result.best_value, *best);
  EXPECT_EQ(result.best_point, std::vector<double>(row, row + kDimension));
}

TEST_P(EveryOptimizer, SameSeedSameBits) {
  const Trace first = trace_of(Sphere(kDimension), evaluations(), 5);
  const Trace second = trace_of(Sphere(kDimension), evaluations(), 5);
  EXPECT_EQ(first.points, second.points);
  EXPECT_EQ(first.values, second.values);
  EXPECT_EQ(first.batch_sizes, second.batch_sizes);
}

TEST_P(EveryOptimizer, AnotherSeedIsAnotherRunUnlessDeterministic) {
  const Trace first = trace_of(Sphere(kDimension), evaluations(), 5);
  const Trace second = trace_of(Sphere(kDimension), evaluations(), 6);
  EXPECT_EQ(first.points != second.points, optimizer().uses_seed());
}

TEST_P(EveryOptimizer, RunsBesideEachOtherDoNotMix) {
  const Trace alone = trace_of(Sphere(kDimension), evaluations());
  Trace one, two;
  std::thread other([&] { run(Sphere(kDimension), evaluations(), one); });
  run(Sphere(kDimension), evaluations(), two);
  other.join();
  EXPECT_EQ(one.points, alone.points);
  EXPECT_EQ(two.points, alone.points);
}

TEST_P(EveryOptimizer, ImprovesOnItsStart) {
  const Sphere sphere(kDimension);
  const std::vector<double> start(kDimension, 0.95);
  Trace trace;
  const MinimizeResult result = run(sphere, evaluations(), trace, 1, start);
  ASSERT_GE(trace.points.size(), kDimension);
  EXPECT_EQ(std::vector<double>(trace.points.begin(), trace.points.begin() + kDimension), start);
  EXPECT_LT(result.best_value, 0.2 * sphere.value(start));
}

TEST_P(EveryOptimizer, NeverLosesAGoodStart) {
  const Sphere sphere(kDimension);
  std::vector<double> start(kDimension, 0.9);  // two starts, the second one perfect
  for (std::size_t i = 0; i < kDimension; ++i) start.push_back(Sphere::centre(i));
  Observer silent;
  EXPECT_EQ(run(sphere, 50, silent, 1, start).best_value, 0);
}

TEST_P(EveryOptimizer, BudgetOfOneIsOneEvaluation) {
  const Sphere sphere(kDimension);
  Observer silent;
  const MinimizeResult result = run(sphere, 1, silent);
  EXPECT_EQ(result.evaluations, 1);
  EXPECT_EQ(sphere.count(), 1);
  EXPECT_EQ(result.best_point.size(), kDimension);
  EXPECT_EQ(result.stopped_by, StopReason::budget);
}

TEST_P(EveryOptimizer, StopsAtTheTarget) {
  const Sphere sphere(kDimension);
  Observer silent;
  const MinimizeResult result = optimizer().minimize(sphere, {}, Budget{5000, 0.1}, {}, 1, silent);
  EXPECT_EQ(result.stopped_by, StopReason::target);
  EXPECT_LE(result.best_value, 0.1);
  EXPECT_LT(result.evaluations, 5000);
  EXPECT_EQ(result.evaluations, sphere.count());
}

TEST_P(EveryOptimizer, StopsForTheObserverAndRepeatsByCount) {
  const Trace whole = trace_of(Sphere(kDimension), 200);
  for (long count : {0L, 1L, 37L, 100L}) {
    Trace cut(count);
    const MinimizeResult result = run(Sphere(kDimension), 200, cut);
    EXPECT_EQ(result.stopped_by, StopReason::observer);
    expect_prefix(cut, whole);
    if (count == 0) continue;
    Observer silent;
    const MinimizeResult repeated = run(Sphere(kDimension), result.evaluations, silent);
    EXPECT_EQ(repeated.best_value, result.best_value);
    EXPECT_EQ(repeated.best_point, result.best_point);
  }
}

TEST_P(EveryOptimizer, SmallerBudgetIsAPrefix) {
  const Trace whole = trace_of(Sphere(kDimension), 200);
  for (long budget : {2L, 7L, 61L, 199L}) {
    const Trace cut = trace_of(Sphere(kDimension), budget);
    EXPECT_EQ(static_cast<long>(cut.values.size()), budget);
    expect_prefix(cut, whole);
  }
}

TEST_P(EveryOptimizer, TakesValuesThatAreNotNumbers) {
  Trace trace;
  const MinimizeResult result = run(Holed(kDimension), evaluations(), trace);
  EXPECT_EQ(result.evaluations, evaluations());
  for (double value : trace.values) ASSERT_TRUE(std::isfinite(value));
  for (double coordinate : trace.points) ASSERT_TRUE(coordinate >= 0 && coordinate <= 1) << coordinate;
  EXPECT_GE(result.best_value, 0);
}

TEST_P(EveryOptimizer, EndsOnAFlatFunction) {
  Trace trace;
  const MinimizeResult result = run(Flat(kDimension), evaluations(), trace);
  EXPECT_EQ(result.evaluations, evaluations());
  EXPECT_EQ(result.best_value, 3);
  EXPECT_TRUE(std::equal(result.best_point.begin(), result.best_point.end(), trace.points.begin()));
}

TEST_P(EveryOptimizer, PassesOnTheObjectivesError) {
  for (long limit : {1L, 23L}) {
    const Failing failing(kDimension, limit);
    Observer silent;
    EXPECT_THROW(run(failing, evaluations(), silent), std::runtime_error);
  }
}

TEST_P(EveryOptimizer, WorksInItsDimensions) {
  for (std::size_t dimension : {1u, 2u, 40u}) {
    const Sphere sphere(dimension);
    Observer silent;
    if (dimension < optimizer().min_dimension() || dimension > optimizer().max_dimension()) {
      EXPECT_THROW(run(sphere, 100, silent), InputError);
      EXPECT_EQ(sphere.count(), 0);
    } else {
      EXPECT_EQ(run(sphere, 100, silent).evaluations, 100) << dimension;
    }
  }
}

TEST_P(EveryOptimizer, RejectsUnknownSettings) {
  expect_rejected({{"no_such_setting", 1}}, {}, {}, "no_such_setting");
}

TEST_P(EveryOptimizer, RejectsSettingsOutOfRange) {
  for (const OptimizerSetting& info : optimizer().settings()) {
    EXPECT_GE(info.default_value, info.lower);
    EXPECT_LE(info.default_value, info.upper);
    EXPECT_FALSE(info.help.empty());
    expect_rejected({{info.name, info.lower - 1}}, {}, {}, info.name);
    expect_rejected({{info.name, info.upper + 1}}, {}, {}, info.name);
    expect_rejected({{info.name, std::numeric_limits<double>::quiet_NaN()}}, {}, {}, info.name);
    if (info.whole) expect_rejected({{info.name, info.lower + 0.5}}, {}, {}, "whole");
  }
}

TEST_P(EveryOptimizer, TakesSettingsAtTheEndsOfTheirRanges) {
  for (const OptimizerSetting& info : optimizer().settings())
    for (double value : {info.lower, std::min(info.upper, 1000.0)}) {
      Observer silent;
      const Sphere sphere(kDimension);
      const auto result = optimizer().minimize(sphere, {{info.name, value}}, Budget{60}, {}, 1, silent);
      EXPECT_EQ(result.evaluations, 60) << info.name << " = " << value;
    }
}

TEST_P(EveryOptimizer, RejectsAnEmptyBudget) {
  expect_rejected({}, Budget{0}, {}, "budget");
  expect_rejected({}, Budget{-5}, {}, "budget");
}

TEST_P(EveryOptimizer, RejectsATargetThatIsNotANumber) {
  expect_rejected({}, Budget{10, std::numeric_limits<double>::quiet_NaN()}, {}, "target");
}

TEST_P(EveryOptimizer, RejectsStartsThatDoNotFit) {
  expect_rejected({}, {}, std::vector<double>(kDimension + 1, 0.5), "start");
  expect_rejected({}, {}, std::vector<double>(kDimension, 1.5), "start");
  expect_rejected({}, {}, std::vector<double>(kDimension, std::numeric_limits<double>::quiet_NaN()), "start");
}

TEST_P(EveryOptimizer, RejectsAnObjectiveWithoutDimensions) {
  Observer silent;
  EXPECT_THROW(run(Flat(0), 10, silent), InputError);
}

TEST(NloptAlgorithms, NoscalVariantsAreTheSameSearch) {
  Trace expected;
  optimizer_by_name("GN_DIRECT_L_NOSCAL").minimize(Sphere(10), {}, Budget{2000}, {}, 1, expected);
  for (const char* name : {"GN_DIRECT_NOSCAL", "GN_DIRECT_L_RAND_NOSCAL"}) {
    Trace trace;
    optimizer_by_name(name).minimize(Sphere(10), {}, Budget{2000}, {}, 1, trace);
    EXPECT_EQ(trace.points, expected.points) << name;
  }
}

TEST(NloptAlgorithms, OrigDirectConvergesWhereItsRectanglesAreTooSmallToDivide) {
  const Sphere sphere(1);
  Observer silent;
  const auto result = optimizer_by_name("GN_ORIG_DIRECT").minimize(sphere, {}, Budget{200000}, {}, 1, silent);
  EXPECT_EQ(result.stopped_by, StopReason::converged);
  EXPECT_LT(result.evaluations, 200000);
  EXPECT_EQ(result.evaluations, sphere.count());
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const auto& optimizer : all_optimizers()) names.push_back(optimizer->name());
  return names;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), ':', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, EveryOptimizer, testing::ValuesIn(all_names()), test_name);

TEST(OptimizerByName, FindsEachByItsName) {
  for (const std::string& name : all_names()) EXPECT_EQ(optimizer_by_name(name).name(), name);
}

TEST(OptimizerByName, NamesTheClosestWhereThereIsNone) {
  try {
    optimizer_by_name("LN_SBPLEX");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("LN_SBPLX"), std::string::npos) << error.what();
  }
}

TEST(OptimizerDocs, NameEveryOptimizerAndSetting) {
  std::ifstream file(ESPALIER_SOURCE_DIR "/docs/optimizers.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  for (const auto& optimizer : all_optimizers()) {
    EXPECT_NE(text.find("| `" + optimizer->name() + "`"), std::string::npos) << optimizer->name();
    for (const OptimizerSetting& info : optimizer->settings())
      EXPECT_NE(text.find("`" + info.name + "`"), std::string::npos) << info.name;
  }
}

}  // namespace
}  // namespace espalier
