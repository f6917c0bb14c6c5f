// The prior: valid plants around every species, moved as much as it says, the same for the same key.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

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

}  // namespace
}  // namespace espalier
