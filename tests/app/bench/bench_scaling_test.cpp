// How time grows with a quantity, as the exponent of a power law.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/app/bench/bench_scaling.h>

namespace espalier {
namespace {

TEST(BenchScaling, ExponentIsThatOfThePowerLaw) {
  ScalingSeries series{"leaves", {}};
  for (const double leaves : {10.0, 100.0, 3000.0})
    series.points.emplace_back(leaves, 2e-6 * std::pow(leaves, 0.7));
  EXPECT_NEAR(scaling_exponent(series), 0.7, 1e-9);
  EXPECT_EQ(scaling_exponent({"threads", {{1, 0.5}}}), 0);
}

}  // namespace
}  // namespace espalier
