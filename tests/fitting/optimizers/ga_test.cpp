// How the modern GA uses its operators: from which parents children come, how often they are crossed and
// mutated, which individuals stay. Read off the points it asks for, which a test of convergence does not see.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/test_functions.h"

namespace espalier {
namespace {

using namespace test;

constexpr std::size_t kGenes = 20, kPopulation = 100;
using Point = std::vector<double>;

/// A generation without elites: its points and their values.
struct Generation {
  std::vector<Point> points;
  std::vector<double> values;

  const Point& best() const {
    return points[std::size_t(std::min_element(values.begin(), values.end()) - values.begin())];
  }
};

std::vector<Generation> run_ga(OptimizerSettings settings, std::size_t generations,
                               const Objective& objective = Sphere(kGenes)) {
  settings["population"] = kPopulation;
  settings.insert({"elites", 0});
  Trace trace;
  const Budget budget{long(kPopulation * generations)};
  optimizer_by_name("ga").minimize(objective, settings, budget, {}, 3, trace);
  std::vector<Generation> all;
  std::size_t row = 0;
  for (const std::size_t size : trace.batch_sizes) {
    Generation& generation = all.emplace_back();
    for (std::size_t i = 0; i < size; ++i, ++row) {
      const auto first = trace.points.begin() + long(row * kGenes);
      generation.points.emplace_back(first, first + kGenes);
      generation.values.push_back(trace.values[row]);
    }
  }
  return all;
}

std::size_t in_common(const Point& a, const Point& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < kGenes; ++i) count += a[i] == b[i];
  return count;
}

/// The most coordinates that the point shares with one of the parents.
std::size_t from_one_parent(const Point& child, const std::vector<Point>& parents) {
  std::size_t most = 0;
  for (const Point& parent : parents) most = std::max(most, in_common(child, parent));
  return most;
}

/// The coordinates that the point has from any parent, in the same place.
std::size_t from_any_parent(const Point& child, const std::vector<Point>& parents) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < kGenes; ++i)
    count += std::any_of(parents.begin(), parents.end(), [&](const Point& p) { return p[i] == child[i]; });
  return count;
}

double mean_over(const Generation& children, auto measure) {
  double sum = 0;
  for (const Point& child : children.points) sum += double(measure(child));
  return sum / double(children.points.size());
}

TEST(Ga, ChildrenThatAreNotCrossedHaveOneParent) {
  const auto run = run_ga({{"crossover_chance", 0}}, 2);
  for (const Point& child : run[1].points)
    EXPECT_EQ(from_one_parent(child, run[0].points), from_any_parent(child, run[0].points));
}

/// A chance of 1/n for each coordinate at first, which each child varies: exp(0.22 N), 1.02 in the mean.
TEST(Ga, AnUncrossedChildMutatesOneCoordinateOnAverage) {
  const auto run = run_ga({{"crossover_chance", 0}}, 2);
  const double kept = mean_over(run[1], [&](const Point& p) { return from_one_parent(p, run[0].points); });
  EXPECT_NEAR(double(kGenes) - kept, 1.02, 5 / std::sqrt(double(kPopulation)));
}

TEST(Ga, UniformCrossoverGivesEachParentHalfOfTheCoordinates) {
  const auto run = run_ga({{"crossover_chance", 1}, {"crossover", 1}, {"tournament", 1}}, 2);
  const auto of_both = [&](const Point& p) { return from_any_parent(p, run[0].points); };
  const auto of_one = [&](const Point& p) { return from_one_parent(p, run[0].points); };
  EXPECT_NEAR(mean_over(run[1], of_both), kGenes - 1.02, 0.5);
  // The larger part of 20 fair coins is 11.8 in the mean, less a mutation of half of them.
  EXPECT_NEAR(mean_over(run[1], of_one), 11.8 * (1 - 1.02 / kGenes), 0.8);
}

TEST(Ga, SbxMovesAllCoordinatesAndLessWithALargerIndex) {
  const auto nearest = [](double eta) {
    const auto run = run_ga({{"crossover_chance", 1}, {"crossover", 0}, {"crossover_eta", eta}}, 2);
    EXPECT_LT(mean_over(run[1], [&](const Point& p) { return from_any_parent(p, run[0].points); }), 1);
    return mean_over(run[1], [&](const Point& child) {
      double least = 1e9;
      for (const Point& parent : run[0].points) {
        double sum = 0;
        for (std::size_t i = 0; i < kGenes; ++i) sum += std::fabs(child[i] - parent[i]);
        least = std::min(least, sum);
      }
      return least;
    });
  };
  EXPECT_LT(2 * nearest(100), nearest(5));
}

TEST(Ga, EitherCrossoverComesUpHalfOfTheTimeAndAsOftenAsItsChance) {
  const auto crossed_by_sbx = [](double chance) {
    const auto run = run_ga({{"crossover_chance", chance}, {"crossover", 2}}, 2);
    return mean_over(run[1], [&](const Point& p) { return from_any_parent(p, run[0].points) < 5; });
  };
  EXPECT_NEAR(crossed_by_sbx(1), 0.5, 0.2);
  EXPECT_NEAR(crossed_by_sbx(0.4), 0.2, 0.17);
}

/// Of a tournament as large as it gets, the best is sure to be a parent.
TEST(Ga, TheLargestTournamentMakesAllChildrenThoseOfTheBest) {
  const auto run = run_ga({{"crossover_chance", 0}, {"tournament", 1000}}, 4);
  for (std::size_t g = 1; g < run.size(); ++g)
    for (const Point& child : run[g].points)
      EXPECT_GE(in_common(child, run[g - 1].best()), kGenes - 8) << "generation " << g;
}

TEST(Ga, ATournamentOfOneTakesAnyParent) {
  const auto run = run_ga({{"crossover_chance", 0}, {"tournament", 1}}, 2);
  std::size_t with_children = 0;
  for (const Point& parent : run[0].points)
    with_children += from_one_parent(parent, run[1].points) >= kGenes - 8;
  EXPECT_NEAR(double(with_children), 100 * (1 - std::exp(-1.0)), 25);
}

/// The later a point is asked for, the worse it is: no child can take an elite's place.
class EverWorse : public RowFunction {
 public:
  using RowFunction::RowFunction;
  double value(std::span<const double>) const override { return ++asked_; }

 private:
  mutable double asked_ = 0;
};

TEST(Ga, TheEliteIsTheBestAndStaysWhereNoChildIsBetter) {
  const EverWorse worse(kGenes);
  const auto run = run_ga({{"crossover_chance", 0}, {"tournament", 1000}, {"elites", 1}}, 4, worse);
  const Point& first = run[0].points[0];
  for (std::size_t g = 1; g < run.size(); ++g)
    for (const Point& child : run[g].points)
      EXPECT_GE(in_common(child, first), kGenes - 8) << "generation " << g;
}

/// With an elite, the best of all that were ever seen goes on having children.
TEST(Ga, AnEliteStaysAParentUntilABetterOneIsFound) {
  const auto run = run_ga({{"crossover_chance", 0}, {"tournament", 1000}, {"elites", 1}}, 8);
  Point best;
  double best_value = 1e9;
  for (std::size_t g = 0; g + 1 < run.size(); ++g) {
    EXPECT_EQ(run[g].points.size(), g == 0 ? kPopulation : kPopulation - 1);
    const double value = *std::min_element(run[g].values.begin(), run[g].values.end());
    if (value < best_value) best_value = value, best = run[g].best();
    for (const Point& child : run[g + 1].points) EXPECT_GE(in_common(child, best), kGenes - 10);
  }
}

}  // namespace
}  // namespace espalier
