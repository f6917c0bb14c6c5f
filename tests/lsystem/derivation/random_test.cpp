// random() of L-systems: each call of it draws its own number, for each module, step and seed, whether the
// expression is compiled or Lua's. Independent numbers are uncorrelated; equal ones have correlation 1.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "support/strings.h"

namespace espalier::lsystem {
namespace {

constexpr int kModules = 3000;
using Numbers = std::vector<double>;

/// The parameters of the B modules of the last string, by place: "B(.1,.2)B(.3,.4)" gives {.1,.3}, {.2,.4}.
std::vector<Numbers> parameters_of_b(const std::string& string) {
  std::vector<Numbers> columns;
  for (std::size_t at = string.find("B("); at != std::string::npos; at = string.find("B(", at)) {
    at += 2;
    std::stringstream list(string.substr(at, string.find(')', at) - at));
    std::string number;
    for (std::size_t column = 0; std::getline(list, number, ','); ++column) {
      if (columns.size() <= column) columns.emplace_back();
      columns[column].push_back(std::stod(number));
    }
  }
  return columns;
}

/// What the productions make of many modules A in one step, and of what follows in more.
std::vector<Numbers> drawn(const std::string& productions, int steps = 2, Seed seed = 1) {
  const std::string text = "axiom: S\nproductions:\n S --> lua\n   for i = 1, " + std::to_string(kModules) +
                           " do produce('A', i) end\n" + productions;
  return parameters_of_b(strings_of(text, steps, seed).back());
}

void expect_uniform(const Numbers& numbers) {
  ASSERT_GE(numbers.size(), std::size_t(kModules));
  double mean = 0, square = 0;
  for (const double x : numbers) {
    EXPECT_TRUE(x >= 0 && x < 1) << x;
    mean += x / double(numbers.size());
    square += x * x / double(numbers.size());
  }
  EXPECT_NEAR(mean, 0.5, 5 / std::sqrt(12.0 * double(numbers.size())));
  EXPECT_NEAR(square - mean * mean, 1.0 / 12, 0.006);
}

void expect_independent(const Numbers& a, const Numbers& b) {
  ASSERT_EQ(a.size(), b.size());
  double covariance = 0;
  for (std::size_t i = 0; i < a.size(); ++i) covariance += (a[i] - 0.5) * (b[i] - 0.5) / double(a.size());
  EXPECT_LT(std::fabs(12 * covariance), 5 / std::sqrt(double(a.size())));  // the correlation
}

void expect_uniform_and_independent(const std::vector<Numbers>& columns) {
  ASSERT_GE(columns.size(), 2u);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    expect_uniform(columns[i]);
    for (std::size_t j = 0; j < i; ++j) expect_independent(columns[i], columns[j]);
  }
}

TEST(Random, TwoCallsInOneProductionAreIndependent) {
  expect_uniform_and_independent(drawn(" A(i) --> B(random(), random())\n"));
}

TEST(Random, TwoCallsInOneExpressionAreIndependent) {
  const Numbers sums = drawn(" A(i) --> B(random() + random())\n").at(0);
  double square = 0;
  for (const double sum : sums) square += (sum - 1) * (sum - 1) / double(sums.size());
  EXPECT_NEAR(square, 2.0 / 12, 0.01);  // twice the same would give 4/12
}

TEST(Random, TwoCallsInLuaAreIndependent) {
  expect_uniform_and_independent(drawn(" A(i) --> lua\n   produce('B', random(), random())\n"));
}

TEST(Random, ACompiledCallAndOneInLuaAreIndependent) {
  expect_uniform_and_independent(
      drawn(" A(i) --> C(random())\n"
            " C(u) --> lua\n   produce('B', u, random())\n",
            3));
}

TEST(Random, NeighboursAreIndependent) {
  const Numbers numbers = drawn(" A(i) --> B(random())\n").at(0);
  expect_independent(Numbers(numbers.begin(), numbers.end() - 1),
                     Numbers(numbers.begin() + 1, numbers.end()));
}

TEST(Random, TwoStepsAreIndependent) {
  expect_uniform_and_independent(drawn(" A(i) --> C(random())\n C(u) --> B(u, random())\n", 3));
}

TEST(Random, TwoSeedsAreIndependentAndOneRepeats) {
  const std::string text = " A(i) --> B(random())\n";
  expect_independent(drawn(text, 2, 1).at(0), drawn(text, 2, 2).at(0));
  EXPECT_EQ(drawn(text, 2, 1), drawn(text, 2, 1));
}

}  // namespace
}  // namespace espalier::lsystem
