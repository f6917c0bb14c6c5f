// The dissertation's genetic algorithm: one parameter a child, in proportion to its value, flips where the
// bounds hold the other sign; the two fittest merged; elitist and not.
#include <gtest/gtest.h>

#include <set>

#include <espalier/fitting/optimizers/hewitt_ga.h>

#include "support/test_functions.h"

namespace espalier {
namespace {

using namespace test;

/// Parameters from -10 to 10 (even dimensions) and from 0 to 10 (odd ones).
class Signed : public Sphere {
 public:
  using Sphere::Sphere;
  double lower(std::size_t i) const { return i % 2 == 0 ? -10 : 0; }
  double value_of(std::size_t i, double unit) const override { return lower(i) + unit * (10 - lower(i)); }
  double unit_of(std::size_t i, double value) const override {
    return std::clamp((value - lower(i)) / (10 - lower(i)), 0.0, 1.0);
  }
};

std::vector<std::size_t> changed(const std::vector<double>& a, std::span<const double> b) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i]) indices.push_back(i);
  return indices;
}

TEST(PermuteOneParameter, ChangesExactlyOneAndReachesAll) {
  const Sphere sphere(6);
  const std::vector<double> parent(6, 0.5);
  std::set<std::size_t> reached;
  for (std::uint64_t i = 0; i < 300; ++i) {
    std::vector<double> child = parent;
    RandomStream draws = random_stream_at(root_key(1), 0, i);
    permute_one_parameter(sphere, {}, draws, child);
    const auto indices = changed(parent, child);
    ASSERT_EQ(indices.size(), 1u);
    reached.insert(indices[0]);
  }
  EXPECT_EQ(reached.size(), 6u);
}

TEST(PermuteOneParameter, ChangeIsProportionalToTheParametersValue) {
  const Signed objective(1);
  HewittNumbers numbers;
  numbers.flip_chance = 0;
  for (double value : {-8.0, -0.5, 0.01, 4.0}) {
    double least = 1e9, most = -1e9;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      std::vector<double> child = {objective.unit_of(0, value)};
      RandomStream draws = random_stream_at(root_key(1), 0, i);
      permute_one_parameter(objective, numbers, draws, child);
      const double ratio = objective.value_of(0, child[0]) / value;
      least = std::min(least, ratio);
      most = std::max(most, ratio);
    }
    EXPECT_NEAR(least, 0.5, 0.01) << value;
    EXPECT_NEAR(most, value == -8 ? 1.25 : 1.5, 0.01) << value;  // -12 is clamped to the bound, -10
  }
}

TEST(PermuteOneParameter, FlipsTheSignWithItsChanceWhereTheBoundsHoldIt) {
  const Signed objective(2);
  HewittNumbers numbers;
  numbers.step = 0;
  numbers.flip_chance = 0.25;
  int flips = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const std::vector<double> parent = {objective.unit_of(0, 4), objective.unit_of(1, 4)};
    std::vector<double> child = parent;
    RandomStream draws = random_stream_at(root_key(2), 0, i);
    permute_one_parameter(objective, numbers, draws, child);
    flips += std::fabs(objective.value_of(0, child[0]) + 4) < 1e-9;
    EXPECT_NEAR(child[1], parent[1], 1e-12);  // 0 to 10 has no negative side
  }
  EXPECT_NEAR(flips, 4000 * 0.25 / 2, 5 * std::sqrt(4000 * 0.125 * 0.875));
}

TEST(PermuteOneParameter, ZeroStaysUnlessZeroStepMovesIt) {
  const Sphere sphere(1);
  HewittNumbers numbers;
  std::vector<double> child = {0};
  RandomStream draws(root_key(1));
  for (int i = 0; i < 50; ++i) permute_one_parameter(sphere, numbers, draws, child);
  EXPECT_EQ(child[0], 0);
  numbers.zero_step = 0.1;
  double most = 0;
  for (int i = 0; i < 500; ++i) {
    child = {0};
    permute_one_parameter(sphere, numbers, draws, child);
    most = std::max(most, child[0]);
  }
  EXPECT_NEAR(most, 0.1, 0.002);  // of the box
}

TEST(MergeParents, TakesEachParameterFromEitherParentEquallyOften) {
  const Sphere sphere(2000);
  const std::vector<double> a(2000, 0.25), b(2000, 0.75);
  RandomStream draws(root_key(1));
  const std::vector<double> merged = merge_parents(sphere, {}, draws, a, b);
  const auto from_b = std::count(merged.begin(), merged.end(), 0.75);
  EXPECT_EQ(from_b + std::count(merged.begin(), merged.end(), 0.25), 2000);
  EXPECT_NEAR(static_cast<double>(from_b), 1000, 5 * std::sqrt(500));
}

TEST(MergeParents, MeanIsTheMeanOfTheValues) {
  const Signed objective(2);
  HewittNumbers numbers;
  numbers.merge_mean = true;
  RandomStream draws(root_key(1));
  const std::vector<double> a = {objective.unit_of(0, -6), 0.3}, b = {objective.unit_of(0, 2), 0.3};
  const std::vector<double> merged = merge_parents(objective, numbers, draws, a, b);
  EXPECT_NEAR(objective.value_of(0, merged[0]), -2, 1e-12);
  EXPECT_EQ(merged[1], 0.3);
}

/// The children of the first generation from a start, in the objective's values.
std::vector<double> first_children(const Signed& objective, double start, const OptimizerSettings& settings) {
  Trace trace;
  const std::vector<double> point(objective.dimension(), objective.unit_of(0, start));
  optimizer_by_name("hewitt_ga").minimize(objective, settings, Budget{1 + 24}, point, 3, trace);
  std::vector<double> children;
  for (std::size_t i = 1; i < trace.points.size(); ++i)
    children.push_back(objective.value_of(0, trace.points[i]));
  return children;
}

TEST(HewittGa, HandsItsSettingsToItsOperators) {
  const Signed objective(1);
  for (double child : first_children(objective, 4, {{"step", 0}, {"flip_chance", 0}}))
    EXPECT_NEAR(child, 4, 1e-12);
  for (double child : first_children(objective, 4, {{"step", 0}, {"flip_chance", 1}}))
    EXPECT_NEAR(child, -4, 1e-12);
  double most = 0;
  for (double child : first_children(objective, 4, {{"step", 0.01}, {"flip_chance", 0}}))
    most = std::max(most, std::fabs(child - 4));
  EXPECT_NEAR(most, 0.04, 0.01);
  for (double child : first_children(objective, 0, {{"flip_chance", 0}})) EXPECT_NEAR(child, 0, 1e-12);
  EXPECT_GT(first_children(objective, 0, {{"flip_chance", 0}, {"zero_step", 0.1}}).size(), 0u);
  for (double child : first_children(objective, 0, {{"flip_chance", 0}, {"zero_step", 0.1}}))
    EXPECT_NE(child, 0);
}

/// Of 30 parameters a child changes one, so the middle one of each among 24 children is their parent's.
std::vector<double> parent_of(std::span<const double> children) {
  std::vector<double> parent;
  for (std::size_t i = 0; i < 30; ++i) {
    std::vector<double> values;
    for (std::size_t row = 0; row < 24; ++row) values.push_back(children[30 * row + i]);
    std::nth_element(values.begin(), values.begin() + 12, values.end());
    parent.push_back(values[12]);
  }
  return parent;
}

TEST(HewittGa, MergesTheTwoFittestByTheirMeanWhereItIsTold) {
  Trace trace;
  const std::vector<double> start(30, 0.9);
  const OptimizerSettings settings = {{"merge_mean", 1}, {"flip_chance", 0}};
  optimizer_by_name("hewitt_ga").minimize(Sphere(30), settings, Budget{1 + 24 * 2}, start, 3, trace);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 1; i <= 24; ++i) order.push_back({trace.values[i], i});
  std::sort(order.begin(), order.end());
  const auto row = [&](std::size_t i) { return std::span(trace.points).subspan(30 * i, 30); };
  const std::vector<double> parent = parent_of(std::span(trace.points).subspan(30 * 25));
  EXPECT_EQ(changed(start, parent).size(), 2u);
  for (std::size_t i = 0; i < 30; ++i)
    EXPECT_NEAR(parent[i], (row(order[0].second)[i] + row(order[1].second)[i]) / 2, 1e-12) << i;
}

/// The best value of each generation of 24 in a run of hewitt_ga.
std::vector<double> generation_bests(double elitist) {
  Trace trace;
  const Sphere sphere(4);
  optimizer_by_name("hewitt_ga").minimize(sphere, {{"elitist", elitist}}, Budget{24 * 60}, {}, 3, trace);
  std::vector<double> bests;
  for (std::size_t i = 0; i < trace.values.size(); i += 24)
    bests.push_back(*std::min_element(trace.values.begin() + long(i), trace.values.begin() + long(i) + 24));
  return bests;
}

/// How many children differ from the first child's generation's common parent in one coordinate only.
TEST(HewittGa, ChildrenOfAGenerationShareAParentBasedOnTheTwoFittest) {
  Trace trace;
  const Sphere sphere(4);
  optimizer_by_name("hewitt_ga").minimize(sphere, {}, Budget{24 * 20}, {}, 3, trace);
  const auto row = [&](std::size_t i) { return std::span(trace.points).subspan(4 * i, 4); };
  for (std::size_t generation = 0; generation + 1 < 20; ++generation) {
    std::vector<std::size_t> order(24);
    for (std::size_t i = 0; i < 24; ++i) order[i] = generation * 24 + i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return trace.values[a] < trace.values[b]; });
    for (std::size_t i = 0; i < 24; ++i) {
      int foreign = 0;  // coordinates that neither of the two fittest has
      const auto child = row((generation + 1) * 24 + i);
      for (std::size_t j = 0; j < 4; ++j)
        foreign += child[j] != row(order[0])[j] && child[j] != row(order[1])[j];
      ASSERT_LE(foreign, 1) << "generation " << generation + 1 << ", child " << i;
    }
  }
}

TEST(HewittGa, NonElitistTakesTheCurrentBestEvenWhereWorse) {
  const std::vector<double> bests = generation_bests(0);
  EXPECT_FALSE(std::is_sorted(bests.rbegin(), bests.rend()));
}

TEST(HewittGa, ElitistKeepsItsParentsUntilAChildImproves) {
  Trace trace;
  const Flat flat(4);  // the first generation is accepted, and none after it
  const std::vector<double> start(4, 0.5);
  optimizer_by_name("hewitt_ga").minimize(flat, {{"elitist", 1}}, Budget{1 + 24 * 5}, start, 3, trace);
  for (std::size_t i = 1; i < trace.values.size(); ++i)
    EXPECT_LE(changed(start, std::span(trace.points).subspan(4 * i, 4)).size(), 1u);
  Trace drifting;
  optimizer_by_name("hewitt_ga").minimize(flat, {}, Budget{1 + 24 * 5}, start, 3, drifting);
  EXPECT_GT(changed(start, std::span(drifting.points).last(4)).size(), 1u);
}

}  // namespace
}  // namespace espalier
