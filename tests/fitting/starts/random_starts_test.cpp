// Starts that nobody chose: they grow, they differ, and the same seed draws the same.
#include <gtest/gtest.h>

#include <set>

#include <espalier/core/field_error.h>
#include <espalier/fitting/starts/random_starts.h>
#include <espalier/models/models.h>

namespace espalier {
namespace {

constexpr GrowthBudget kDrawBudget{2'000, 20'000};
constexpr double kDrawHeightM = 7;

const Model& tree_model() { return model_by_name("weber_penn"); }

std::vector<StartPoint> draw(int draws, Seed seed, const SearchChoice& choice = {}) {
  return random_starts(tree_model(), draws, choice, kDrawBudget, kDrawHeightM, seed);
}

TEST(RandomStarts, GrowAsTallAsTheTargetWithinTheBudget) {
  for (const StartPoint& point : draw(12, 3)) {
    Plant plant;
    ASSERT_TRUE(tree_model().generate(point.values, 3, {kDrawBudget, nullptr}, plant).grown) << point.name;
    EXPECT_NEAR(bounds(plant).upper.z, kDrawHeightM, 0.1 * kDrawHeightM) << point.name;
    for (std::size_t i = 0; i < point.values.size(); ++i)
      EXPECT_NO_THROW(check_value(tree_model().table().rows[i], point.values[i], point.name));
  }
}

TEST(RandomStarts, AreTheSameForASeedAndOthersForAnother) {
  const auto once = draw(4, 1), again = draw(4, 1), other = draw(4, 2);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].values, again[i].values);
    EXPECT_NE(once[i].values, other[i].values);
  }
  EXPECT_EQ(draw(2, 1)[1].values, once[1].values) << "more draws do not change the first";
}

TEST(RandomStarts, DifferInEveryParameterThatIsSearched) {
  const auto points = draw(12, 5);
  const ParameterTable& table = tree_model().table();
  const SearchSpace space =
      make_search_space(table, table.defaults(), {.free = {"curve_v*", "down_angle*", "ratio"}});
  for (const FreeParameter& parameter : space.free) {
    std::set<double> values;
    for (const StartPoint& point : points) values.insert(point.values[parameter.row]);
    EXPECT_EQ(values.size(), points.size()) << parameter.name;
  }
}

TEST(RandomStarts, KeepWhatIsFixedAndTheRangesOfTheSearch) {
  const SearchChoice choice{.fixed = {{"levels", 2.0}}, .ranges = {{"ratio", {0.02, 0.03}}}};
  for (const StartPoint& point : draw(8, 1, choice)) {
    EXPECT_EQ(point.values[tree_model().table().index_of("levels")], 2);
    EXPECT_GE(point.values[tree_model().table().index_of("ratio")], 0.02);
    EXPECT_LE(point.values[tree_model().table().index_of("ratio")], 0.03);
  }
}

TEST(RandomStarts, WithoutRoomToGrowAreRefused) {
  EXPECT_THROW(random_starts(tree_model(), 1, {.fixed = {{"branches[0]", 50.0}}}, {10, 10}, kDrawHeightM, 1),
               FieldError);
}

}  // namespace
}  // namespace espalier
