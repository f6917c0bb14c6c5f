// Random search is the floor: each other method's median over 9 seeds on the sphere in 10 dimensions after
// 2,000 evaluations lies below random search's. No exceptions. NEWUOA_BOUND, whose own steps are slow, has to
// do it in 200 (a run with a smaller budget is a prefix, so this asks for more).
#include <gtest/gtest.h>

#include <algorithm>

#include <espalier/fitting/optimizers/optimizer.h>

#include "support/test_functions.h"

namespace espalier {
namespace {

double median_on_sphere(const Optimizer& optimizer, long evaluations) {
  std::vector<double> best;
  for (Seed seed = 1; seed <= 9; ++seed) {
    Observer silent;
    const test::Sphere sphere(10);
    best.push_back(optimizer.minimize(sphere, {}, Budget{evaluations}, {}, seed, silent).best_value);
  }
  std::nth_element(best.begin(), best.begin() + 4, best.end());
  return best[4];
}

TEST(RandomSearchFloor, EveryOtherMethodLiesBelow) {
  const double floor = median_on_sphere(optimizer_by_name("random_search"), 2000);
  for (const auto& optimizer : all_optimizers()) {
    if (optimizer->name() == "random_search") continue;
    const bool slow = optimizer->name().find("NEWUOA") != std::string::npos;
    EXPECT_LT(median_on_sphere(*optimizer, slow ? 200 : 2000), floor) << optimizer->name();
  }
}

}  // namespace
}  // namespace espalier
