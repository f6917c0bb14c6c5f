// Trees grown by vector instructions are those that the plain formulas grow, whatever the species.
#include <gtest/gtest.h>

#include "models/preset.h"
#include "weber_penn/grow.h"

namespace espalier {
namespace {

Plant grown(const WeberPennParameters& p, Seed seed, Lanes lanes) {
  Plant plant;
  EXPECT_TRUE(grow_tree(p, seed, {}, plant, lanes).grown);
  return plant;
}

float largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  float largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, length(a[i] - b[i]));
  return largest;
}

/// A leaf that is bent outwards by a share of half a turn goes either way.
std::size_t differing(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += length(a[i] - b[i]) > 2e-2f;
  return count;
}

class VectorGrowth : public testing::TestWithParam<std::string> {};

TEST_P(VectorGrowth, IsThatOfThePlainFormulas) {
  const Preset preset = load_preset(GetParam());
  if (preset.model != "weber_penn") GTEST_SKIP() << "another model";
  const WeberPennParameters p = weber_penn_parameters(preset.values);
  for (Seed seed = 1; seed <= 3; ++seed) {
    const Plant vector = grown(p, seed, Lanes::many), plain = grown(p, seed, Lanes::one);
    ASSERT_EQ(vector.stems.path_key, plain.stems.path_key);
    ASSERT_EQ(vector.stems.parent, plain.stems.parent);
    ASSERT_EQ(vector.stems.first_knot, plain.stems.first_knot);
    ASSERT_EQ(vector.leaves.size(), plain.leaves.size());
    EXPECT_LT(largest_difference(vector.knots.point_m, plain.knots.point_m), 2e-3f);
    EXPECT_LT(largest_difference(vector.knots.handle_in_m, plain.knots.handle_in_m), 2e-3f);
    EXPECT_LT(largest_difference(vector.knots.handle_out_m, plain.knots.handle_out_m), 2e-3f);
    EXPECT_LT(largest_difference(vector.leaves.position_m, plain.leaves.position_m), 2e-3f);
    EXPECT_LE(differing(vector.leaves.axis, plain.leaves.axis), plain.leaves.size() / 10'000);
    for (std::size_t knot = 0; knot < plain.knots.size(); ++knot)
      ASSERT_NEAR(vector.knots.radius_m[knot], plain.knots.radius_m[knot], 1e-5f);
  }
}

INSTANTIATE_TEST_SUITE_P(Species, VectorGrowth, testing::ValuesIn(bundled_presets()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace espalier
