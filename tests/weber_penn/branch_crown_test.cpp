// Crowns of single branches: foliage pads, whose stems reach to an envelope from the branch's base to its
// tip.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/models/preset.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/weber_penn/model.h>
#include <espalier/weber_penn/placed_crown.h>
#include <espalier/weber_penn/tree_crown.h>

namespace espalier {
namespace {

constexpr BranchCrown kFlat{
    .radius = {0.5f, 0.12f, 0.3f, 0.08f}, .rim = {0.4f, 0.5f, 0.6f, 0.5f}, .shape_tip = 1.5f};

/// An aspen without leaves, of which branch 0/30 has a crown.
struct PaddedTree {
  ParameterValues values;
  Overrides overrides;

  explicit PaddedTree(const BranchCrown& crown = kFlat, double levels = 4)
      : values(load_preset("quaking_aspen").values) {
    set("levels", levels);
    set("leaf_blos_num", 0);
    set("branches[3]", 6);
    set("length[3]", 0.3);
    overrides.at({0, 30}).set.crown = crown;
  }
  void set(const char* name, double value) { values[weber_penn_table().index_of(name)] = value; }

  Plant grown(const Volume* prune_to = nullptr) const {
    const ChangeGraph changes(overrides);
    Plant plant;
    EXPECT_TRUE(
        weber_penn_model().generate(values, 1, {.prune_to = prune_to, .changes = &changes}, plant).grown);
    return plant;
  }
};

Vec3 base_of(const Plant& plant, std::size_t stem) {
  return plant.knots.point_m[plant.stems.first_knot[stem]];
}
Vec3 tip_of(const Plant& plant, std::size_t stem) {
  return plant.knots.point_m[plant.stems.first_knot[stem + 1] - 1];
}

std::size_t stem_of(const Plant& plant, const BranchPath& path) {
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    if (path_of(plant, stem) == path) return stem;
  ADD_FAILURE() << "no branch " << to_string(path);
  return 0;
}

/// As the branch has it.
PlacedCrown pad_of(const Plant& plant, const BranchPath& path, const BranchCrown& crown = kFlat) {
  const std::size_t stem = stem_of(plant, path);
  StemTurtle base;
  base.position_m = base_of(plant, stem);
  return PlacedCrown(crown, base, tip_of(plant, stem));
}

bool is_on(const BranchPath& path, const BranchPath& with) {
  return path.size() >= with.size() && std::equal(with.begin(), with.end(), path.begin());
}

TEST(BranchCrown, TipsOfItsStemsLieOnIt) {
  const Plant plant = PaddedTree(kFlat, 3).grown();
  const PlacedCrown pad = pad_of(plant, {0, 30});
  int count = 0;
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    const BranchPath path = path_of(plant, stem);
    if (path.size() != 3 || !is_on(path, {0, 30})) continue;
    EXPECT_LT(std::fabs(pad.signed_distance_m(tip_of(plant, stem))),
              0.01f * length(tip_of(plant, stem) - base_of(plant, stem)) + 0.003f);
    ++count;
  }
  EXPECT_GT(count, 10);
}

TEST(BranchCrown, WhatGrowsOnThemStaysInIt) {
  const Plant plant = PaddedTree().grown();
  const PlacedCrown pad = pad_of(plant, {0, 30});
  int count = 0;
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    const BranchPath path = path_of(plant, stem);
    if (path.size() != 4 || !is_on(path, {0, 30})) continue;
    EXPECT_TRUE(pad.contains(tip_of(plant, stem)));
    ++count;
  }
  EXPECT_GT(count, 20);
}

TEST(BranchCrown, ItChangesNothingButWhatIsOnItsBranch) {
  PaddedTree tree;
  const Plant with_pad = tree.grown();
  tree.overrides.nodes.clear();
  const Plant without = tree.grown();
  for (std::size_t stem = 0; stem < without.stems.size(); ++stem) {
    const BranchPath path = path_of(without, stem);
    if (is_on(path, {0, 30}) && path.size() > 2) continue;
    if (path.size() > 2 && path[1] % 5 != 0) continue;  // some are enough
    EXPECT_LT(length(tip_of(with_pad, stem_of(with_pad, path)) - tip_of(without, stem)), 1e-4f);
  }
}

TEST(BranchCrown, ItsSidesAreRightUpLeftAndDown) {
  StemTurtle base;
  base.position_m = {1, 0, 5};
  const PlacedCrown pad(kFlat, base, {1, 2, 5});  // seen along the branch, x is to the right
  const Vec3 middle{1, 1, 5};
  const BranchCrown round{.radius = kFlat.radius};
  const PlacedCrown ellipsoid(round, base, {1, 2, 5});
  const std::pair<Vec3, float> sides[] = {
      {{1, 0, 0}, 0.5f}, {{0, 0, 1}, 0.12f}, {{-1, 0, 0}, 0.3f}, {{0, 0, -1}, 0.08f}};
  for (const auto& [side, radius] : sides) EXPECT_NEAR(ellipsoid.reach_m(middle, side), 2 * radius, 1e-3);
  EXPECT_NEAR(pad.reach_m({1, 0, 5}, {0, 1, 0}), 2, 1e-3);  // its top is the tip
  EXPECT_TRUE(pad.surely_contains_ball(middle, 0.05f));
  EXPECT_FALSE(pad.surely_contains_ball(middle, 0.2f));
  EXPECT_NEAR(ellipsoid.signed_distance_m({1, 1, 5.5f}), 0.5 - 0.24, 0.05);
}

TEST(BranchCrown, WhereTheTreeHasACrownThatGivesLengthsItsTopIsOnThat) {
  PaddedTree tree(kFlat, 3);
  tree.set("crown_use", 2);
  tree.set("crown_radius_left", 0.6);
  const Plant plant = tree.grown();
  const CrownEnvelope crown(crown_shape(weber_penn_parameters(tree.values), plant.tree_scale_m));
  const std::size_t branch = stem_of(plant, {0, 30});
  EXPECT_LT(std::fabs(crown.signed_distance_m(tip_of(plant, branch))),
            0.01f * length(tip_of(plant, branch) - base_of(plant, branch)));
  const PlacedCrown pad = pad_of(plant, {0, 30});
  int count = 0;
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    if (const BranchPath path = path_of(plant, stem); path.size() == 3 && is_on(path, {0, 30})) {
      EXPECT_LT(std::fabs(pad.signed_distance_m(tip_of(plant, stem))), 0.02f);
      ++count;
    }
  EXPECT_GT(count, 10);
}

TEST(BranchCrown, OfATrunkItGivesTheBranchesTheirLengths) {
  PaddedTree tree(kFlat, 2);
  tree.overrides.nodes.clear();
  tree.overrides.at({0}).set.crown = BranchCrown{};
  const Plant plant = tree.grown();
  const std::size_t trunk = stem_of(plant, {0});
  EXPECT_GT(plant.stems.size(), 20u);
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    if (plant.stems.level[stem] != 1) continue;
    StemTurtle base;
    base.position_m = base_of(plant, trunk);
    const Vec3 tip = tip_of(plant, stem), middle = lerp(base_of(plant, trunk), tip_of(plant, trunk), 0.5f);
    const float half_m = 0.5f * length(tip_of(plant, trunk) - base_of(plant, trunk));
    const Vec3 along = normalized(tip_of(plant, trunk) - base_of(plant, trunk));
    const float z = dot(tip - middle, along), r = length(tip - middle - along * z);
    EXPECT_NEAR(std::hypot(z / half_m, r / (0.6f * half_m)), 1, 0.01);  // an ellipsoid of revolution
  }
}

TEST(BranchCrown, AVolumeThatIsGivenCutsItAsWell) {
  const auto volume = make_cylinder({0, 0, 0}, 1.5f, 60);
  const Plant plant = PaddedTree(kFlat, 3).grown(volume.get());
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    EXPECT_TRUE(!is_on(path_of(plant, stem), {0, 30}) || volume->contains(tip_of(plant, stem)));
}

}  // namespace
}  // namespace espalier
