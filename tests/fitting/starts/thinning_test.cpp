// Plants are thinned to their growth budget, whatever the model calls its counts.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/fitting/starts/thinning.h>
#include <espalier/models/preset.h>

#include "support/lsystem_files.h"
#include "support/toy_model.h"

namespace espalier {
namespace {

constexpr GrowthBudget kSmall{2'000, 5'000};

ParameterValues thinned(const Model& model, ParameterValues values) {
  EXPECT_TRUE(thin_until_grown(model, kSmall, 1, values));
  return values;
}

TEST(Thinning, IsTheSameUnderOtherNames) {
  const ToyModel toy;
  for (const char* name : {"quaking_aspen", "weeping_willow", "black_oak"}) {
    const ParameterValues values = load_preset(name).values;
    const ParameterValues thin = thinned(ToyModel::original(), values);
    EXPECT_NE(thin, values) << name;
    EXPECT_EQ(ToyModel::translated(thinned(toy, ToyModel::translated(values))), thin) << name;
  }
}

TEST(Thinning, LeavesAloneWhatBearsNoRoles) {
  const ToyWithoutRoles toy;
  const ParameterValues values = ToyModel::translated(load_preset("quaking_aspen").values);
  ParameterValues thin = values;
  EXPECT_FALSE(thin_until_grown(toy, kSmall, 1, thin));
  EXPECT_EQ(thin, values);
}

TEST(Thinning, FewerLeavesCoverAsMuch) {
  const ParameterTable& table = ToyModel::original().table();
  const std::size_t count = table.index_of("leaf_blos_num"), length = table.index_of("leaf_scale");
  const ParameterValues before = load_preset("small_pine").values;
  ParameterValues after = before;
  thin_to_budget(ToyModel::original(), {1e9, 2'000}, after);
  ASSERT_LT(after[count], before[count]);
  EXPECT_NEAR(after[count] * std::pow(after[length], 2) / (before[count] * std::pow(before[length], 2)), 1,
              1e-9);
}

/// A pole with twigs of leaves: `twigs` times `leaves` of them.
std::string pole(const std::string& twigs_role, const std::string& leaves_role) {
  return "param twigs = 60 in 2 .. 500 integer " + twigs_role + "\nparam leaves = 40 in 1 .. 100 integer " +
         leaves_role + R"(
axiom: A
productions:
  A --> lua
    for i = 1, twigs do
      produce("F", 0.1, "/", 137, "[&", 60)
      for k = 1, leaves do produce("F", 0.02, "[+", 50, "L", "]") end
      produce("]")
    end
interpretation:
  L --> ~("leaf", 0.1)
)";
}

TEST(Thinning, AnLsystemThatDeclaresRolesIsThinnedByWhatGrows) {
  const GrowthBudget few_leaves{1'000, 300}, few_stems{20, 10'000};
  const Model& model = lsystem_model_of("twigs.lsys", pole("role branch_count", "role leaf_count"));
  for (const GrowthBudget& budget : {few_leaves, few_stems}) {
    ParameterValues values = model.table().defaults();
    Plant plant;
    ASSERT_FALSE(model.generate(values, 1, {.budget = budget}, plant).grown);
    EXPECT_TRUE(thin_until_grown(model, budget, 1, values));
    EXPECT_TRUE(model.generate(values, 1, {.budget = budget}, plant).grown);
    EXPECT_GT(plant.leaves.size(), 0u);
    for (std::size_t i = 0; i < values.size(); ++i) check_value(model.table().rows[i], values[i], "thinned");
  }
}

TEST(Thinning, AnLsystemWithoutRolesStaysAsItIs) {
  const Model& model = lsystem_model_of("bare_twigs.lsys", pole("", ""));
  ParameterValues values = model.table().defaults();
  EXPECT_FALSE(thin_until_grown(model, {1'000, 300}, 1, values));
  EXPECT_EQ(values, model.table().defaults());
}

}  // namespace
}  // namespace espalier
