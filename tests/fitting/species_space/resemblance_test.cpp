#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <espalier/fitting/species_space/preset_collection.h>
#include <espalier/fitting/species_space/resemblance.h>
#include <espalier/models/models.h>

namespace espalier {
namespace {

const std::vector<Preset>& species() {
  static const std::vector<Preset> presets = load_presets({});
  return presets;
}

const SpeciesSpace& space() {
  static const SpeciesSpace made = make_species_space(species(), "monotone", 2);
  return made;
}

/// A species of any height is itself.
TEST(Resemblance, EverySpeciesIsItsOwnNearestWhateverItsSize) {
  const ParameterTable& table = space().model->table();
  for (const Preset& preset : species()) {
    ParameterValues larger = preset.values;
    for (std::size_t i = 0; i < larger.size(); ++i)
      if (table.rows[i].unit == "m") larger[i] *= 1.7;
    const std::vector<Resemblance> found = resemblances(space(), larger);
    ASSERT_EQ(found.size(), species().size());
    EXPECT_EQ(found.front().species, preset.name);
    EXPECT_NEAR(found.front().departure, 0, 1e-9) << preset.name;
    EXPECT_GT(found[1].departure, 0.2) << preset.name;
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end(),
                               [](const auto& a, const auto& b) { return a.departure < b.departure; }));
  }
}

/// What resemblance.h says of them, and docs/species_space.md.
TEST(Resemblance, TheNextSpeciesIsAboutOneStandardDeviationAway) {
  std::vector<double> to_the_next;
  for (const Preset& preset : species())
    to_the_next.push_back(resemblances(space(), preset.values)[1].departure);
  std::sort(to_the_next.begin(), to_the_next.end());
  EXPECT_NEAR(to_the_next.front(), 0.55, 0.25);
  EXPECT_NEAR(to_the_next[to_the_next.size() / 2], 1, 0.25);
  EXPECT_NEAR(to_the_next.back(), 1.5, 0.4);
}

/// One number that all species of this depth have, moved by one standard deviation: 1/√n of those that count.
TEST(Resemblance, DepartureIsARootMeanSquareInStandardDeviations) {
  const Preset aspen = load_preset("quaking_aspen");
  const std::size_t row = *space().model->table().find("down_angle[1]");
  const auto& columns = space().encoding->columns();
  const auto column =
      std::find_if(columns.begin(), columns.end(), [&](const EncodingColumn& one) { return one.row == row; });
  ASSERT_NE(column, columns.end());
  const double deviation = space().pca.deviation[column - columns.begin()];
  ParameterValues turned = aspen.values;
  turned[row] += deviation;
  const EncodedValues encoded = space().encoding->encode(aspen.values);
  double count = 0;
  for (std::size_t i = 0; i < columns.size(); ++i)
    count += encoded.means[i] && space().pca.deviation[static_cast<Eigen::Index>(i)] > 0;
  const std::vector<Resemblance> found = resemblances(space(), turned);
  EXPECT_EQ(found.front().species, "quaking_aspen");
  EXPECT_NEAR(found.front().departure, 1 / std::sqrt(count), 1e-6);
}

}  // namespace
}  // namespace espalier
