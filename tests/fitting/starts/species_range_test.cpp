// Laws of what a species allows of its parameters.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/fitting/starts/fit_plan.h>
#include <espalier/fitting/starts/species_range.h>
#include <espalier/fitting/starts/start_points.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {
namespace {

const ParameterTable& weber_penn() { return model_by_name("weber_penn").table(); }

std::vector<ParameterValues> all_species() {
  std::vector<ParameterValues> all;
  for (const StartPoint& start : presets_as_written(weber_penn(), StartNames{})) all.push_back(start.values);
  return all;
}

ParameterValues values_of(const std::string& species) { return load_preset(species).values; }

TEST(SpeciesRange, TheSpreadIsTheStandardDeviation) {
  const std::vector<ParameterValues> all = all_species();
  const std::size_t row = weber_penn().index_of("down_angle[1]");
  double sum = 0, squares = 0;
  for (const ParameterValues& values : all) {
    sum += values[row];
    squares += values[row] * values[row];
  }
  const double n = static_cast<double>(all.size()), mean = sum / n;
  EXPECT_NEAR(spread_of_species(weber_penn(), all)[row], std::sqrt(squares / n - mean * mean), 1e-9);
}

TEST(SpeciesRange, TheSizeOfATreeChangesNothing) {
  std::vector<ParameterValues> all = all_species();
  const std::vector<double> spread = spread_of_species(weber_penn(), all);
  ParameterValues large = values_of("apple");
  scale_plant(weber_penn(), 2, large);
  SearchChoice of_small, of_large;
  keep_to_species(weber_penn(), values_of("apple"), spread, of_small);
  keep_to_species(weber_penn(), large, spread, of_large);
  EXPECT_DOUBLE_EQ(of_large.ranges.at("leaf_scale").upper, 2 * of_small.ranges.at("leaf_scale").upper);
  EXPECT_DOUBLE_EQ(of_large.ranges.at("down_angle[1]").upper, of_small.ranges.at("down_angle[1]").upper);
  for (ParameterValues& values : all) scale_plant(weber_penn(), 0.5, values);
  const std::vector<double> halved = spread_of_species(weber_penn(), all);
  const std::size_t leaf = weber_penn().index_of("leaf_scale");
  EXPECT_NEAR(halved[leaf], spread[leaf], 1e-6 * spread[leaf]);
}

TEST(SpeciesRange, ASpeciesAllowsHalfASpreadAndFixesChoices) {
  const std::vector<double> spread = spread_of_species(weber_penn(), all_species());
  const ParameterValues apple = values_of("apple");
  SearchChoice choice;
  choice.fixed = {{"leaf_shape", 2.0}};
  keep_to_species(weber_penn(), apple, spread, choice);
  const std::size_t row = weber_penn().index_of("down_angle[1]");
  const SearchRange range = choice.ranges.at("down_angle[1]");
  EXPECT_DOUBLE_EQ(range.lower, apple[row] - spread[row] / 2);
  EXPECT_DOUBLE_EQ(range.upper, apple[row] + spread[row] / 2);
  EXPECT_EQ(choice.fixed.at("leaf_shape"), 2) << "what the user fixes stays";
  EXPECT_EQ(choice.fixed.at("shape"), apple[weber_penn().index_of("shape")]);
  EXPECT_FALSE(choice.ranges.contains("g_scale") || choice.fixed.contains("g_scale"));
  for (const auto& [name, bounds] : choice.ranges) {
    const double value = apple[weber_penn().index_of(name)];
    EXPECT_LE(bounds.lower, value) << name;
    EXPECT_GE(bounds.upper, value) << name;
  }
}

TEST(SpeciesRange, APlanThatKeepsToASpeciesStartsAndStaysThere) {
  FitRecord record;
  record.views = {{std::filesystem::path(ESPALIER_SOURCE_DIR) / "targets/tr_fir.png", {}}};
  record.target.size_px = 64;
  record.growth = {600, 6'000};
  record.kind = KindChoice::automatic;
  record.species = "apple";
  const FitTask task = make_task(record);
  const FitPlan plan = plan_of(record, task);
  ASSERT_FALSE(plan.starts.empty());
  const std::vector<double> spread = spread_of_species(weber_penn(), all_species());
  const std::size_t angle = weber_penn().index_of("down_angle[1]");
  for (const StartPoint& start : plan.starts) {
    EXPECT_TRUE(start.name.starts_with("apple")) << start.name;
    EXPECT_NEAR(start.values[angle], values_of("apple")[angle], spread[angle] / 2 + 1e-9);
  }
  record.species = "no_such_species";
  EXPECT_THROW(plan_of(record, task), InputError);
}

}  // namespace
}  // namespace espalier
