// Laws of the price of wood that no leaf covers, where the picture's crown expects leaves.
#include <gtest/gtest.h>

#include <espalier/fitting/picture/crown.h>
#include <espalier/fitting/task/plant_scorer.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

FitTask task_of(KindChoice kind, double price, const char* picture = "reference_apple.png") {
  FitRecord record;
  record.views = {{fs::path(ESPALIER_SOURCE_DIR) / "targets" / picture, {}}};
  record.target.size_px = 64;
  record.kind = kind;
  record.bare_wood_price = price;
  return make_task(record);
}

Mask empty(const Mask& like) { return Mask(like.width_px(), like.height_px()); }

TEST(BareWood, ACrownIsWhatTheMaskHasAboveItsBase) {
  Mask mask(20, 20);
  for (int y = 0; y < 10; ++y) mask.set(10, y + 5), mask.set(3, y + 5);
  const Mask crown = crown_of(mask, {.crown_base = 0.4}, {});
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) EXPECT_EQ(crown.get(x, y), mask.get(x, y) && y < 11) << x << ' ' << y;
}

TEST(BareWood, CostsItsPriceTimesTheShareOfTheCrownThatOnlyWoodCovers) {
  for (const double price : {0.1, 0.5}) {
    const FitTask task = task_of(KindChoice::leafy, price), free = task_of(KindChoice::leafy, 0);
    const Mask& target = task.views[0].target.mask();
    const double plain = score_of_masks(free, {&target, 1}, {});
    const Mask none = empty(target);
    EXPECT_EQ(plain, 0);
    EXPECT_EQ(score_of_masks(task, {&target, 1}, {&target, 1}), 0);
    EXPECT_DOUBLE_EQ(score_of_masks(task, {&target, 1}, {&none, 1}), price);
    // Half of the crown's rows bear leaves.
    const Mask& crown = task.views[0].crown;
    Mask half = none;
    for (int y = 0; y < crown.height_px(); y += 2) std::ranges::copy(crown.row(y), half.row(y).begin());
    const double share = 1 - double(area_px(half)) / double(area_px(crown));
    EXPECT_DOUBLE_EQ(score_of_masks(task, {&target, 1}, {&half, 1}), price * share);
  }
}

TEST(BareWood, CostsNothingBesideTheCrownOrOnTheTrunk) {
  const FitTask task = task_of(KindChoice::leafy, 1), free = task_of(KindChoice::leafy, 0);
  Mask outside = task.views[0].crown;
  for (std::uint64_t& word : outside.words()) word = ~word;
  const Mask none = empty(outside);
  EXPECT_EQ(score_of_masks(task, {&outside, 1}, {&none, 1}), score_of_masks(free, {&outside, 1}, {}));
}

TEST(BareWood, IsNotLookedForOnOtherKindsOfTrees) {
  for (const KindChoice kind : {KindChoice::any, KindChoice::leafless, KindChoice::palm})
    EXPECT_FALSE(expects_leaves(task_of(kind, 1)));
  EXPECT_TRUE(expects_leaves(task_of(KindChoice::leafy, 1)));
  EXPECT_FALSE(expects_leaves(task_of(KindChoice::leafy, 0)));
  EXPECT_TRUE(expects_leaves(task_of(KindChoice::automatic, 1)));
  EXPECT_FALSE(expects_leaves(task_of(KindChoice::automatic, 1, "tr_crookedtree4.png")));
}

TEST(BareWood, TheScorerTakesItFromATreeWithoutLeaves) {
  const FitTask task = task_of(KindChoice::leafy, 0.3), free = task_of(KindChoice::leafy, 0);
  ParameterValues leafy = load_preset("apple").values, bare = leafy;
  bare[task.model->table().index_of("leaf_blos_num")] = 0;
  const auto rise = [&](const ParameterValues& values) {
    double with = 0, without = 0;
    PlantScorer(task, 1).score({&values, 1}, {&with, 1});
    PlantScorer(free, 1).score({&values, 1}, {&without, 1});
    return with - without;
  };
  EXPECT_GT(rise(bare), 0.01);
  EXPECT_GE(rise(leafy), 0);
  EXPECT_LT(rise(leafy), rise(bare));
}

/// Two columns of a crown, the left of which shows leaves and the right wood.
TargetView labelled_view() {
  Mask mask(8, 8), leaf(8, 8), wood(8, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 2; x < 6; ++x) {
      mask.set(x, y);
      (x < 4 ? leaf : wood).set(x, y);
    }
  TargetView view = make_target_view(mask, 8, {}, 10);
  view.labels = {.leaf = leaf, .wood = wood, .leaf_share = 0.5, .wood_share = 0.5};
  view.crown = crown_of(mask, view.reading, view.labels);
  return view;
}

TEST(Labels, TheCrownIsWhatShowsLeavesAndNotWhatShowsWood) {
  const TargetView view = labelled_view();
  EXPECT_EQ(view.crown, view.labels.leaf);
}

TEST(Labels, WoodInTheLeavesPlaceAndLeavesInTheWoodsCostTheSame) {
  FitTask task;
  task.objective = parse_objective("iou");
  task.bare_wood_price = 0.4;
  task.views = {labelled_view()};
  const Mask& target = task.views[0].target.mask();
  const auto score = [&](const Mask& leaves) { return score_of_masks(task, {&target, 1}, {&leaves, 1}); };
  EXPECT_EQ(score(task.views[0].labels.leaf), 0);
  EXPECT_DOUBLE_EQ(score(task.views[0].labels.wood), 0.4);
  EXPECT_DOUBLE_EQ(score(target), 0.2) << "leaves over the wood";
  EXPECT_DOUBLE_EQ(score(empty(target)), 0.2) << "wood in the place of leaves";
}

TEST(Labels, AnOpenCrownWithLeavesIsLeafy) {
  const PlantLabels leaves{.leaf_share = 0.4, .wood_share = 0.3}, few{.leaf_share = 0.1, .wood_share = 0.8};
  EXPECT_EQ(kind_with_labels(TreeKind::leafless, leaves), TreeKind::leafy);
  EXPECT_EQ(kind_with_labels(TreeKind::leafless, few), TreeKind::leafless);
  EXPECT_EQ(kind_with_labels(TreeKind::leafless, {}), TreeKind::leafless);
  EXPECT_EQ(kind_with_labels(TreeKind::palm, leaves), TreeKind::palm);
  EXPECT_EQ(kind_with_labels(TreeKind::leafy, few), TreeKind::leafy);
}

/// The fir's crown is green, so a task of it has labels, and its hash tells them from a task without.
TEST(Labels, AreReadWhereTheRecordAsksForThem) {
  FitRecord record;
  record.views = {{fs::path(ESPALIER_SOURCE_DIR) / "targets/fir.png", {}}};
  record.target.size_px = 64;
  FitRecord without = record;
  without.target.labels = LabelChoice::none;
  const FitTask labelled = make_task(record), plain = make_task(without);
  EXPECT_GT(labelled.views[0].labels.leaf_share, 0.5);
  EXPECT_FALSE(plain.views[0].labels.are_known());
  EXPECT_NE(record.target_hash, without.target_hash);
  const PlantLabels& labels = labelled.views[0].labels;
  const Mask& mask = labelled.views[0].target.mask();
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) EXPECT_LE(labels.leaf.get(x, y) + labels.wood.get(x, y), mask.get(x, y));
}

}  // namespace
}  // namespace espalier
