// The modern GA's operators: each law fails for a broken operator, which a test of convergence would not see.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include <espalier/fitting/optimizers/ga_operators.h>

#include "support/test_functions.h"

namespace espalier {
namespace {

double fraction() {
  return *rc::gen::map(rc::gen::inRange(0, 1000001), [](int i) { return i * 1e-6; });
}

RC_GTEST_PROP(Sbx, KeepsTheMeanOfTheParents, ()) {
  double a = 0.4 + 0.2 * fraction(), b = 0.4 + 0.2 * fraction();
  const double mean = (a + b) / 2;
  RandomStream draws(root_key(*rc::gen::arbitrary<Seed>()));
  sbx_crossover(20, draws, {&a, 1}, {&b, 1});
  RC_ASSERT(std::fabs((a + b) / 2 - mean) < 1e-12);
}

TEST(Sbx, SpreadFactorHasItsDensity) {
  // P(beta < 1) = 1/2 and, for eta = 2, P(beta < 0.5) = 0.5 * 0.5^3 (integral of Deb and Agrawal's eq. 7).
  int below_one = 0, below_half = 0;
  constexpr int kCount = 40000;
  RandomStream draws(root_key(5));
  for (int i = 0; i < kCount; ++i) {
    double a = 0.499, b = 0.501;
    sbx_crossover(2, draws, {&a, 1}, {&b, 1});
    const double beta = (b - a) / 0.002;
    below_one += beta < 1;
    below_half += beta < 0.5;
  }
  EXPECT_NEAR(below_one, kCount * 0.5, 5 * std::sqrt(kCount * 0.25));
  EXPECT_NEAR(below_half, kCount * 0.0625, 5 * std::sqrt(kCount * 0.0625));
}

RC_GTEST_PROP(Sbx, StaysInTheBox, ()) {
  double a = fraction(), b = fraction();
  RandomStream draws(root_key(*rc::gen::arbitrary<Seed>()));
  sbx_crossover(0, draws, {&a, 1}, {&b, 1});
  RC_ASSERT(a >= 0 && a <= 1 && b >= 0 && b <= 1);
}

TEST(UniformCrossover, SwapsWithoutLosingAnything) {
  std::vector<double> a(1000, 0.25), b(1000, 0.75);
  RandomStream draws(root_key(1));
  uniform_crossover(draws, a, b);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i] + b[i], 1);
  EXPECT_NEAR(static_cast<double>(std::count(a.begin(), a.end(), 0.75)), 500, 80);
}

RC_GTEST_PROP(PolynomialStep, StaysInTheBox, ()) {
  const double eta = 2 + 198 * fraction();
  const double stepped = polynomial_step(fraction(), eta, std::min(fraction(), 0.999999));
  RC_ASSERT(stepped >= 0 && stepped <= 1);
}

RC_GTEST_PROP(PolynomialStep, RisesWithTheDrawFromBoundToBound, ()) {
  const double x = fraction(), eta = 2 + 30 * fraction();
  const double u = 0.999 * fraction();
  RC_ASSERT(polynomial_step(x, eta, u) <= polynomial_step(x, eta, u + 0.0005) + 1e-12);
  RC_ASSERT(std::fabs(polynomial_step(x, eta, 0.5) - x) < 1e-12);
  RC_ASSERT(std::fabs(polynomial_step(x, eta, 0)) < 1e-12);
}

TEST(PolynomialStep, LargerIndexMeansSmallerSteps) {
  EXPECT_LT(std::fabs(polynomial_step(0.5, 100, 0.9) - 0.5), std::fabs(polynomial_step(0.5, 10, 0.9) - 0.5));
  // By hand: x = 1/2, eta = 1, u = 7/8: delta = 1 - sqrt(1/4 + 3/4 * 1/4) = 1 - sqrt(7)/4.
  EXPECT_NEAR(polynomial_step(0.5, 1, 0.875), 1.5 - std::sqrt(7.0) / 4, 1e-12);
}

TEST(PolynomialMutation, ChangesTheShareOfCoordinatesItsChanceSays) {
  std::vector<double> point(20000, 0.5);
  RandomStream draws(root_key(1));
  polynomial_mutation({0.2, 20}, draws, point);
  const double same = static_cast<double>(std::count(point.begin(), point.end(), 0.5));
  EXPECT_NEAR(same, 16000, 5 * std::sqrt(3200));
}

TEST(InheritRates, KeepTheGeometricMeanOnAverageAndTheirRanges) {
  double log_chance = 0, log_eta = 0, square_chance = 0, square_eta = 0, product = 0;
  constexpr int kCount = 20000;
  RandomStream draws(root_key(1));
  for (int i = 0; i < kCount; ++i) {
    const MutationRates rates = inherit_rates({0.05, 10}, {0.2, 40}, 100, draws);
    const double chance = std::log(rates.chance / 0.1), eta = std::log(rates.eta / 20);
    log_chance += chance / kCount, square_chance += chance * chance / kCount;
    log_eta += eta / kCount, square_eta += eta * eta / kCount;
    product += chance * eta / kCount;
  }
  EXPECT_NEAR(log_chance, 0, 0.01);
  EXPECT_NEAR(log_eta, 0, 0.01);
  EXPECT_NEAR(std::sqrt(square_chance), 0.22, 0.01);  // Baeck's learning rate
  EXPECT_NEAR(std::sqrt(square_eta), 0.22, 0.01);
  EXPECT_NEAR(product, 0, 0.003);  // each has its own draw
  MutationRates rates{0.5, 2};
  for (int i = 0; i < 1000; ++i) {
    rates = inherit_rates(rates, rates, 10, draws);
    EXPECT_TRUE(rates.chance >= 0.025 && rates.chance <= 0.5 && rates.eta >= 2 && rates.eta <= 200);
  }
}

TEST(Tournament, WinsWithTheChanceOfTheBestOfItsSize) {
  const std::vector<std::size_t> rank = {3, 0, 2, 1};  // individual 1 is the best
  int wins = 0;
  constexpr int kCount = 20000;
  RandomStream draws(root_key(1));
  for (int i = 0; i < kCount; ++i) wins += tournament(rank, 3, draws) == 1;
  const double chance = 1 - std::pow(0.75, 3);
  EXPECT_NEAR(wins, kCount * chance, 5 * std::sqrt(kCount * chance * (1 - chance)));
}

TEST(Tournament, OfOneIsUniformAndAWorseRankNeverBeatsABetter) {
  const std::vector<std::size_t> rank = {3, 0, 2, 1};
  std::vector<int> wins(4), wins_of_two(4);
  RandomStream draws(root_key(2));
  for (int i = 0; i < 16000; ++i)
    ++wins[tournament(rank, 1, draws)], ++wins_of_two[tournament(rank, 2, draws)];
  for (std::size_t i = 0; i < 4; ++i) {
    const double chance = (7 - 2 * double(rank[i])) / 16;  // best of two draws from four
    EXPECT_NEAR(wins[i], 4000, 5 * std::sqrt(3000));
    EXPECT_NEAR(wins_of_two[i], 16000 * chance, 5 * std::sqrt(16000 * chance * (1 - chance)));
  }
}

TEST(Clearing, RanksTheCrowdAroundABetterOneLast) {
  std::vector<Individual> population(4);
  const double places[] = {0.50, 0.51, 0.90, 0.10};
  const double values[] = {1, 2, 3, 4};
  for (std::size_t i = 0; i < 4; ++i) population[i] = {{places[i]}, {}, values[i]};
  EXPECT_EQ(ranks_with_clearing(population, 0), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(ranks_with_clearing(population, 0.05), (std::vector<std::size_t>{0, 3, 1, 2}));
}

TEST(Ga, KeepsItsElitesAndRestartsWhenStagnant) {
  test::Trace trace;
  const test::Flat flat(3);
  optimizer_by_name("ga").minimize(flat, {{"stagnation", 2}, {"population", 10}, {"elites", 2}}, Budget{52},
                                   {}, 1, trace);
  // 10 new ones, then two generations of 8 beside the 2 elites, then a new population.
  EXPECT_EQ(trace.batch_sizes, (std::vector<std::size_t>{10, 8, 8, 10, 8, 8}));
}

}  // namespace
}  // namespace espalier
