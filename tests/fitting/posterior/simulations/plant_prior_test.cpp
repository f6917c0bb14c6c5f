// The prior: valid plants around every species, moved as much as it says, the same for the same key.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <espalier/core/curves/parameter_curves.h>
#include <espalier/core/field_error.h>
#include <espalier/fitting/posterior/simulations/plant_prior.h>
#include <espalier/fitting/starts/species_range.h>
#include <espalier/models/models.h>

namespace espalier {
namespace {

const PlantPrior& prior() {
  static const PlantPrior made(model_by_name("weber_penn"));
  return made;
}

PlantDraw draw(std::uint64_t i) { return prior().draw(child_key(root_key(3), i)); }

RC_GTEST_PROP(PlantPrior, DrawsValidPlantsAndTheSameForTheSameKey, (std::uint64_t i)) {
  const PlantDraw plant = draw(i), again = draw(i);
  RC_ASSERT(plant.values == again.values && plant.seed == again.seed);
  RC_ASSERT(plant.seed != draw(i + 1).seed);
  const ParameterTable& table = prior().model().table();
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    RC_ASSERT(is_valid_value(table.rows[row], plant.values[row]));
}

TEST(PlantPrior, DrawsEverySpeciesAlikeAndNoDemonstration) {
  std::map<std::string, int> counts;
  constexpr int kDraws = 4000;
  for (std::uint64_t i = 0; i < kDraws; ++i) ++counts[prior().species()[draw(i).species].name];
  EXPECT_EQ(counts.size(), prior().species().size());
  EXPECT_FALSE(counts.contains("sphere_tree"));
  for (const auto& [name, count] : counts)
    EXPECT_NEAR(count, kDraws / static_cast<double>(counts.size()), 80) << name;
}

TEST(PlantPrior, MovesWhatTheSearchIsFreeToMoveAndNothingElse) {
  const std::set<std::size_t> rows(prior().rows().begin(), prior().rows().end());
  std::set<std::size_t> moved;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const PlantDraw plant = draw(i);
    const ParameterValues& species = prior().species()[plant.species].values;
    for (std::size_t row = 0; row < species.size(); ++row)
      if (plant.values[row] != species[row]) moved.insert(row);
  }
  EXPECT_EQ(moved, rows);
  for (const std::size_t row : rows) EXPECT_TRUE(prior().model().table().rows[row].free_by_default);
}

/// Rows whose bounds are far away show the whole normal distribution.
TEST(PlantPrior, MovesByHalfOfWhatSpeciesDiffer) {
  const std::size_t row = prior().model().table().index_of("down_angle[1]");
  std::vector<ParameterValues> values;
  for (const Preset& preset : prior().species()) values.push_back(preset.values);
  const std::vector<double> spread = spread_of_species(prior().model().table(), values);
  double squares = 0;
  int count = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const PlantDraw plant = draw(i);
    const double own = prior().species()[plant.species].values[row];
    if (own < 2 * spread[row]) continue;  // the least angle is near
    squares += std::pow((plant.values[row] - own) / (0.5 * spread[row]), 2);
    ++count;
  }
  ASSERT_GT(count, 500);
  EXPECT_NEAR(std::sqrt(squares / count), 1, 0.08);
}

TEST(PlantPrior, KeepsTheSignOfAFlagAndWholeNumbersWhole) {
  const ParameterTable& table = prior().model().table();
  for (std::uint64_t i = 0; i < 500; ++i) {
    const PlantDraw plant = draw(i);
    const ParameterValues& species = prior().species()[plant.species].values;
    for (const std::size_t row : prior().rows()) {
      if (table.rows[row].sign != SignMeaning::flag) continue;
      EXPECT_GE(plant.values[row] * species[row], 0) << table.rows[row].full_name();
    }
  }
}

std::vector<double> curve_numbers(const CurveInfo& curve, const ParameterValues& values) {
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(curve.first_row);
  return {first, first + kCurveRows};
}

RC_GTEST_PROP(PlantPrior, MovesACurveThatIsNamedAndNothingElse, (std::uint64_t i)) {
  static const PlantPrior of_curve(model_by_name("weber_penn"), {.free = {"length_along[1]~4"}});
  const ParameterTable& table = of_curve.model().table();
  const CurveInfo& curve = *table.curve_of(of_curve.rows().front());
  const PlantDraw plant = of_curve.draw(child_key(root_key(3), i));
  ParameterValues expected = of_curve.species()[plant.species].values;
  RC_ASSERT(curve_numbers(curve, plant.values) != curve_numbers(curve, expected));
  const std::vector<double> refined = curve_numbers(curve, plant.values);
  const Curve by_four = make_curve(coarse_numbers(curve, plant.values, 4));
  for (std::size_t k = 0; k < kCurveRows; ++k) {
    RC_ASSERT(std::fabs(refined[k] - by_four.numbers[k]) < 1e-9);
    expected[curve.first_row + k] = plant.values[curve.first_row + k];
  }
  RC_ASSERT(plant.values == expected);
  RC_ASSERT(of_curve.rows().size() == kCurveRows);
}

RC_GTEST_PROP(PlantPrior, MovesTheOtherParametersAsWithoutTheCurve, (std::uint64_t i)) {
  static const PlantPrior with_curve(model_by_name("weber_penn"), {.free = {"default", "bend_along[0]"}});
  const RandomKey key = child_key(root_key(3), i);
  const PlantDraw with = with_curve.draw(key), without = prior().draw(key);
  for (const std::size_t row : prior().rows()) RC_ASSERT(with.values[row] == without.values[row]);
  RC_ASSERT(with_curve.rows().size() == prior().rows().size() + kCurveRows);
}

/// The searched range of this curve, 120 degrees about 0, shows the whole normal distribution.
TEST(PlantPrior, MovesCurvesByAFifthOfTheirRange) {
  const PlantPrior of_curve(model_by_name("weber_penn"), {.free = {"down_angle_along[1]"}});
  double squares = 0, sum = 0;
  constexpr int kDraws = 2000;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const double number = of_curve.draw(child_key(root_key(3), i)).values[of_curve.rows()[3]];
    sum += number, squares += number * number;
  }
  EXPECT_NEAR(sum / kDraws, 0, 2);
  EXPECT_NEAR(std::sqrt(squares / kDraws), 24, 1.5);
}

TEST(PlantPrior, KeepsToASpeciesThatIsKnown) {
  const PlantPrior of_larch(model_by_name("weber_penn"), {.species = {"european_larch"}});
  EXPECT_EQ(of_larch.rows(), prior().rows());
  ASSERT_EQ(of_larch.species().size(), 1U);
  std::size_t larch = 0;
  while (prior().species()[larch].name != "european_larch") ++larch;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const PlantDraw any = draw(i);
    if (any.species != larch) continue;
    EXPECT_EQ(of_larch.draw(child_key(root_key(3), i)).values, any.values);
  }
}

TEST(PlantPrior, RefusesWhatItCannotMove) {
  const Model& model = model_by_name("weber_penn");
  for (const char* name :
       {"g_scale", "lengthh_along[1]", "length_along[1]~3", "branches[1]~4", "crown_top_x"})
    EXPECT_THROW(PlantPrior(model, {.free = {name}}), FieldError) << name;
  EXPECT_THROW(PlantPrior(model, {.species = {"no_such_species"}}), InputError);
}

}  // namespace
}  // namespace espalier
