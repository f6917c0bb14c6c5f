// The bundled designs: plants whose branches were placed by hand. Six bonsai, each with what its style is
// known by [Boudon et al. 2003, Interactive design of bonsai tree models, §5, Figs 11 to 15; docs/bonsai.md].
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <numeric>

#include <espalier/core/files.h>
#include <espalier/image/measures/compare.h>
#include <espalier/models/grow_preset.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/camera.h>
#include <espalier/render/scanlines/scanline_renderer.h>

namespace espalier {
namespace {

namespace fs = std::filesystem;

class Designs : public testing::TestWithParam<std::string> {
 protected:
  Preset preset_ = load_preset(GetParam());
};

Mask silhouette(const Plant& plant, float azimuth_deg = 0) {
  Mask mask;
  make_scanline_renderer()->draw(plant, frame_bounds(bounds(plant), {azimuth_deg, 0}, 256, 256), mask);
  return mask;
}

TEST_P(Designs, HaveShortFilesAndADescription) {
  const std::string text =
      read_file(fs::path(ESPALIER_SOURCE_DIR) / "src/weber_penn/designs" / (GetParam() + ".toml"));
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 80);
  EXPECT_NE(preset_.description, "");
  EXPECT_TRUE(preset_.seed) << "it is one plant, no species";
}

TEST_P(Designs, OverrideBranchesThatGrow) {
  EXPECT_FALSE(preset_.overrides.empty());
  EXPECT_THAT(count_overridden(preset_, GetParam()), testing::Each(testing::Gt(0U)));
}

/// .6 m in a pot, or 6 m in a garden: lengths in metres change, and nothing else.
TEST_P(Designs, LookTheSameAtTenTimesTheSize) {
  const ParameterTable& table = model_by_name(preset_.model).table();
  Preset large = preset_;
  for (const char* name : {"g_scale", "leaf_scale", "least_radius"}) large.values[table.index_of(name)] *= 10;
  const Plant small_plant = grow_preset(preset_, GetParam()), large_plant = grow_preset(large, GetParam());
  const auto counts = [](const Plant& plant) {
    return std::pair(static_cast<double>(plant.stems.size()), static_cast<double>(plant.leaves.size()));
  };
  const auto [stems, leaves] = counts(small_plant);
  EXPECT_NEAR(counts(large_plant).first, stems, 0.01 * stems) << "rounding of floats";
  EXPECT_NEAR(counts(large_plant).second, leaves, 0.01 * leaves);
  for (const float azimuth_deg : {0.0F, 90.0F}) {
    const Mask a = silhouette(small_plant, azimuth_deg), b = silhouette(large_plant, azimuth_deg);
    EXPECT_GT(iou(a, b), 0.98) << azimuth_deg;
  }
}

INSTANTIATE_TEST_SUITE_P(Bundled, Designs, testing::ValuesIn(bundled_designs()),
                         [](const auto& info) { return info.param; });

TEST(Design, NamesAreSortedAndApartFromThoseOfSpecies) {
  const std::vector<std::string> designs = bundled_designs(), species = bundled_presets();
  EXPECT_THAT(designs, testing::SizeIs(6));
  EXPECT_TRUE(std::is_sorted(designs.begin(), designs.end()));
  for (const std::string& name : designs) EXPECT_THAT(species, testing::Not(testing::Contains(name)));
}

/// A bonsai as it grows, and what can be measured of it.
struct Bonsai {
  Plant plant;

  explicit Bonsai(const std::string& style) : plant(grow_preset(load_preset("bonsai_" + style), style)) {}

  std::vector<std::size_t> stems_of_level(int level) const {
    std::vector<std::size_t> stems;
    for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
      if (plant.stems.level[stem] == level) stems.push_back(stem);
    return stems;
  }
  std::vector<Vec3> points_of(std::size_t stem) const {
    const auto begin = plant.knots.point_m.begin();
    return {begin + plant.stems.first_knot[stem], begin + plant.stems.first_knot[stem + 1]};
  }
  std::vector<Vec3> trunk() const { return points_of(0); }
  float height_m() const { return bounds(plant).upper.z; }
};

/// Formal upright: the trunk is straight and upright, and the lower branches are the longer ones.
TEST(Bonsai, ChokkanHasAStraightTrunkAndItsLongestBranchesBelow) {
  const Bonsai tree("chokkan");
  for (const Vec3& point : tree.trunk())
    EXPECT_LT(std::hypot(point.x, point.y), 0.03F * tree.height_m()) << "at height " << point.z;
  const auto branches = tree.stems_of_level(1);
  const auto reach = [&](std::size_t branch) {
    const Vec3 tip = tree.points_of(branch).back();
    return std::hypot(tip.x, tip.y);
  };
  const std::size_t third = branches.size() / 3;
  float low = 0, high = 0;
  for (std::size_t i = 0; i < third; ++i) {
    low += reach(branches[i]);
    high += reach(branches[branches.size() - 1 - i]);
  }
  EXPECT_GT(low, 2 * high);
}

/// Literati: slender and bare, foliage at the top alone.
TEST(Bonsai, BunjinIsBareForMoreThanHalfOfItsHeightAndWinds) {
  const Bonsai tree("bunjin");
  const auto& leaves = tree.plant.leaves.position_m;
  const auto lowest =
      std::min_element(leaves.begin(), leaves.end(), [](Vec3 a, Vec3 b) { return a.z < b.z; });
  EXPECT_GT(lowest->z, 0.5F * tree.height_m());
  const auto trunk = tree.trunk();
  const auto [left, right] =
      std::minmax_element(trunk.begin(), trunk.end(), [](Vec3 a, Vec3 b) { return a.x < b.x; });
  EXPECT_GT(right->x - left->x, 0.12F * tree.height_m());
}

/// Three stems that begin at one point.
TEST(Bonsai, SankanHasThreeTrunksFromOnePoint) {
  const Bonsai tree("sankan");
  const auto trunks = tree.stems_of_level(0);
  ASSERT_THAT(trunks, testing::SizeIs(3));
  const Vec3 fork = tree.points_of(trunks[1]).front();
  EXPECT_EQ(tree.points_of(trunks[2]).front(), fork);
  EXPECT_THAT(tree.trunk(), testing::Contains(fork));
  EXPECT_LT(fork.z, 0.2F * tree.height_m());
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(length(tree.points_of(trunks[i]).back() - tree.points_of(trunks[j]).back()),
                0.1F * tree.height_m());
}

/// Degrees by which a curve turns about the vertical, counted with their sign.
float winding_deg(const std::vector<Vec3>& points) {
  float turned = 0;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const Vec3 a = points[i - 1] - points[i - 2], b = points[i] - points[i - 1];
    turned += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
  }
  return std::abs(turned) * 180 / std::numbers::pi_v<float>;
}

/// Twisted cascade: the trunk winds about the vertical, and its tip hangs.
TEST(Bonsai, NejikanWindsAroundAndHangsOver) {
  const Bonsai tree("nejikan");
  const auto trunk = tree.trunk();
  EXPECT_GT(winding_deg(trunk), 360);
  EXPECT_LT(trunk.back().z, trunk[trunk.size() - 4].z);
  EXPECT_GT(trunk.back().x, 0.5F * tree.height_m());
}

/// Windswept: everything streams to one side.
TEST(Bonsai, FukinagashiStreamsToOneSide) {
  const Bonsai tree("fukinagashi");
  const auto& leaves = tree.plant.leaves.position_m;
  const auto right = std::count_if(leaves.begin(), leaves.end(), [](const Vec3& leaf) { return leaf.x > 0; });
  EXPECT_GT(static_cast<double>(right), 0.95 * static_cast<double>(leaves.size()));
  for (const std::size_t branch : tree.stems_of_level(1))
    EXPECT_GT(tree.points_of(branch).back().x, tree.points_of(branch).front().x) << branch;
}

/// Formal cascade: the trunk rises, then falls below the foot of the tree.
TEST(Bonsai, KengaiRisesAndFallsBelowItsFoot) {
  const Bonsai tree("kengai");
  const auto trunk = tree.trunk();
  const auto top =
      std::max_element(trunk.begin(), trunk.end(), [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
  EXPECT_GT(top->z, 0.05F);
  EXPECT_LT(trunk.back().z, -0.05F);
  EXPECT_LT(bounds(tree.plant).lower.z, -2 * top->z / 3);
  for (auto point = top; point + 1 != trunk.end(); ++point) EXPECT_LT((point + 1)->z, point->z);
}

}  // namespace
}  // namespace espalier
