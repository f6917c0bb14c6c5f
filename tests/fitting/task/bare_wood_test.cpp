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
  const Mask crown = crown_of(mask, {.crown_base = 0.4});
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

}  // namespace
}  // namespace espalier
