// The radius of a child stem [Weber & Penn 95, §4.4; CH §3.2.1: radius_mod]:
// radius_mod · parent radius · (length / parent length)^ratio_power, no thinner than 5 mm, no thicker than
// the parent where it sits.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/weber_penn/scalar/child_stem.h>

namespace espalier {
namespace {

float child_m(float radius_mod, float ratio_power = 1.2f, float length_m = 3, float site_radius_m = 1) {
  WeberPennParameters p;
  p.radius_mod = {9, 9, radius_mod, 9};  // that of the child's level counts
  p.ratio_power = ratio_power;
  return child_radius_m(length_m, 6, 0.4f, site_radius_m, 2, p);
}

TEST(ChildRadius, IsThatOfItsFormula) {
  EXPECT_NEAR(child_m(1), 0.4 * std::pow(0.5, 1.2), 1e-6);
  EXPECT_NEAR(child_m(1, 2), 0.4 * 0.25, 1e-6);
  EXPECT_NEAR(child_m(1, 1, 1.5f), 0.4 * 0.25, 1e-6);
}

TEST(ChildRadius, IsProportionalToTheRadiusModOfItsLevel) {
  for (const float factor : {0.1f, 0.5f, 2.f}) EXPECT_NEAR(child_m(factor), factor * child_m(1), 1e-6);
}

TEST(ChildRadius, IsNeverBelowFiveMillimetresNorAboveTheParents) {
  EXPECT_FLOAT_EQ(child_m(1e-4f), 0.005f);
  EXPECT_FLOAT_EQ(child_m(1, 1.2f, 3, 0.03f), 0.03f);
}

}  // namespace
}  // namespace espalier
