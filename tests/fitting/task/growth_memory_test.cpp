// Laws of the memory that plants may take: more of anything never takes less, and what does not fit is
// refused with the name of what asks for most.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <espalier/core/field_error.h>
#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/task/growth_memory.h>
#include <espalier/models/grow_preset.h>
#include <espalier/models/preset.h>

namespace espalier {
namespace {

constexpr double kGigabyte = 1e9;

RC_GTEST_PROP(GrowthMemory, MoreOfAnythingTakesMore, ()) {
  const double stems = *rc::gen::inRange(1, 1'000'000), leaves = *rc::gen::inRange(1, 1'000'000);
  const GrowthBudget budget{stems, leaves};
  const int threads = *rc::gen::inRange(1, 64);
  const double bytes = growth_memory_bytes(budget, threads);
  RC_ASSERT(growth_memory_bytes({budget.max_stems + 1, budget.max_leaves}, threads) > bytes);
  RC_ASSERT(growth_memory_bytes({budget.max_stems, budget.max_leaves + 1}, threads) > bytes);
  RC_ASSERT(growth_memory_bytes(budget, 2 * threads) == 2 * bytes);
}

TEST(GrowthMemory, BoundsWhatBundledSpeciesTake) {
  for (const std::string name : {"quaking_aspen", "bamboo", "black_oak", "small_pine"}) {
    const Plant plant = grow_preset(load_preset(name), name, {});
    const GrowthBudget used{static_cast<double>(plant.stems.size()),
                            static_cast<double>(plant.leaves.size())};
    EXPECT_GE(growth_memory_bytes(used, 1), static_cast<double>(memory_bytes(plant))) << name;
  }
}

TEST(GrowthMemory, TheDefaultFitsIntoOneGigabyteOnSixteenThreads) {
  EXPECT_NO_THROW(check_growth_memory(FitRecord{}.growth, 16, kGigabyte));
}

std::string refused_field(const GrowthBudget& budget) {
  try {
    check_growth_memory(budget, 1, kGigabyte);
  } catch (const FieldError& error) {
    return error.field;
  }
  return "none";
}

TEST(GrowthMemory, NamesWhatAsksForMost) {
  EXPECT_EQ(refused_field({1e6, 1000}), "growth.max_stems");
  EXPECT_EQ(refused_field({1000, 1e8}), "growth.max_leaves");
  EXPECT_EQ(refused_field({1000, 1000}), "none");
}

}  // namespace
}  // namespace espalier
