// Trees grown by vector instructions are those that the plain formulas grow, whatever the species.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/models/preset.h>
#include <espalier/weber_penn/estimate.h>
#include <espalier/weber_penn/grow.h>

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

class VectorGrowthOf : public testing::TestWithParam<std::string> {};

TEST_P(VectorGrowthOf, IsThatOfThePlainFormulas) {
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

INSTANTIATE_TEST_SUITE_P(Species, VectorGrowthOf, testing::ValuesIn(bundled_presets()),
                         [](const auto& test) { return test.param; });

std::vector<ParameterValues> all_presets() {
  std::vector<ParameterValues> presets;
  for (const std::string& name : bundled_presets())
    if (const Preset preset = load_preset(name); preset.model == "weber_penn")
      presets.push_back(preset.values);
  return presets;
}

/// A bundled preset in which about a third of the parameters have any value of their search bounds; curves in
/// one tree of two.
ParameterValues any_values(const std::vector<ParameterValues>& presets, RandomKey key) {
  ParameterValues values = presets[random_bits(key, 0) % presets.size()];
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ParameterInfo& row = weber_penn_table().rows[i];
    if (uniform_unit(key, 1, static_cast<std::uint32_t>(i)) > 0.3f) continue;
    if (row.point >= 0 && random_bits(key, 3) % 2 == 0) continue;
    const double share = uniform_unit(key, 2, static_cast<std::uint32_t>(i));
    values[i] = row.search_lower + share * (row.search_upper - row.search_lower);
    if (row.scale == Scale::integer || row.scale == Scale::choice) values[i] = std::round(values[i]);
  }
  return values;
}

/// What hangs on a comparison may fall on either side by the last digit: such trees are few.
TEST(VectorGrowth, IsThatOfThePlainFormulasOnRandomTrees) {
  const std::vector<ParameterValues> presets = all_presets();
  int other_stems = 0, moved = 0, grown_trees = 0;
  for (Seed seed = 0; seed < 300; ++seed) {
    const WeberPennParameters p = weber_penn_parameters(any_values(presets, root_key(seed)));
    const GrowthSettings settings{.budget = {1'000, 8'000}};
    if (estimate_growth(p).stems > 1'000) continue;
    Plant vector, plain;
    if (!grow_tree(p, seed, settings, plain, Lanes::one).grown) continue;
    ++grown_trees;
    ASSERT_TRUE(grow_tree(p, seed, settings, vector, Lanes::many).grown) << seed;
    if (vector.stems.path_key != plain.stems.path_key || vector.leaves.size() != plain.leaves.size()) {
      ++other_stems;
      continue;
    }
    ASSERT_EQ(vector.stems.parent, plain.stems.parent) << seed;
    ASSERT_EQ(vector.stems.first_knot, plain.stems.first_knot) << seed;
    moved += largest_difference(vector.knots.point_m, plain.knots.point_m) > 0.01f ||
             largest_difference(vector.leaves.position_m, plain.leaves.position_m) > 0.01f;
  }
  EXPECT_GT(grown_trees, 40);
  EXPECT_LE(other_stems, 3);
  EXPECT_LE(moved, 3);
}

}  // namespace
}  // namespace espalier
