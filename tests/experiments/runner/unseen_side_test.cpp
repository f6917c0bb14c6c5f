#include <gtest/gtest.h>
#include <support/temporary_folders.h>

#include <cmath>

#include <espalier/experiments/runner/unseen_side.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/embree/embree_renderer.h>

namespace espalier {
namespace {

const KnownTree kTree{"small_pine", 5};

/// A fit of the known tree's silhouette from this azimuth, whose height is given.
FitRecord record_of_tree(float azimuth_deg) {
  const Preset preset = load_preset(kTree.species);
  Plant plant;
  model_by_name(preset.model).generate(preset.values, kTree.seed, {}, plant);
  Mask mask;
  make_embree_renderer()->draw(plant, frame_bounds(bounds(plant), {azimuth_deg, 0}, 256, 256), mask);
  FitRecord record;
  record.views.resize(1);
  record.views[0].picture = fresh_folder("unseen_side") / "pine.png";
  record.views[0].view.azimuth_deg = azimuth_deg;
  write_mask_png(record.views[0].picture, mask);
  record.target.size_px = 64;
  record.growth.max_stems = 1e5, record.growth.max_leaves = 1e6;
  record.height_m = bounds(plant).upper.z;
  return record;
}

TEST(UnseenSide, TheTreeItselfMeetsBothSidesAndItsSiblingsMeetThemAlike) {
  const FitResult itself{.values = load_preset(kTree.species).values, .seed = kTree.seed};
  const SideScores scores = score_sides(record_of_tree(0), itself, kTree, 3);
  EXPECT_EQ(scores.front_iou, 1);
  EXPECT_EQ(scores.side_iou, 1);
  EXPECT_NEAR(scores.sibling_front_iou, 0.7, 0.2);
  EXPECT_NEAR(scores.sibling_side_iou, 0.7, 0.2);
}

TEST(UnseenSide, ASiblingAsTheResultScoresAsSiblingsDo) {
  const FitResult sibling{.values = load_preset(kTree.species).values, .seed = 77};
  const SideScores scores = score_sides(record_of_tree(0), sibling, kTree, 3);
  EXPECT_LT(scores.front_iou, 0.95);
  EXPECT_LT(scores.side_iou, 0.95);
}

/// Seen from the other side, front and side change places: half a turn mirrors a silhouette.
TEST(UnseenSide, SideIsAQuarterTurnFromWhereThePictureWasTaken) {
  const FitResult sibling{.values = load_preset(kTree.species).values, .seed = 77};
  const SideScores front = score_sides(record_of_tree(0), sibling, kTree, 1);
  const SideScores side = score_sides(record_of_tree(90), sibling, kTree, 1);
  EXPECT_NEAR(front.side_iou, side.front_iou, 0.015);
  EXPECT_NEAR(front.front_iou, side.side_iou, 0.015);
  EXPECT_GT(std::fabs(front.front_iou - front.side_iou), 0.03);
}

TEST(UnseenSide, OverridesAreOfTheFittedPlantAlone) {
  const Preset preset = load_preset(kTree.species);
  const SideScores plain = score_sides(record_of_tree(0), {.values = preset.values, .seed = 77}, kTree, 2);
  FitResult changed{.values = preset.values, .seed = 77};
  set_override(changed.overrides.at({0}).set, {Quantity::length, Relation::factor, 0.5});
  const SideScores scores = score_sides(record_of_tree(0), changed, kTree, 2);
  EXPECT_NE(scores.front_iou, plain.front_iou);
  EXPECT_EQ(scores.sibling_front_iou, plain.sibling_front_iou);
  EXPECT_EQ(scores.sibling_side_iou, plain.sibling_side_iou);
}

}  // namespace
}  // namespace espalier
