// The choices at a point: a species at the very point decides alone, near ones count most, demonstrations not
// at all, and the order of the presets is none of their business.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <espalier/fitting/species_space/choice_votes.h>
#include <espalier/fitting/species_space/preset_collection.h>

namespace espalier {
namespace {

const SpeciesSpace& bundled_map() {
  static const SpeciesSpace kSpace = make_species_space(load_presets({}), "monotone", 2);
  return kSpace;
}

const SpeciesPoint& species_called(const SpeciesSpace& space, const std::string& name) {
  return *std::find_if(space.species.begin(), space.species.end(),
                       [&](const SpeciesPoint& species) { return species.name == name; });
}

std::vector<double> choices_of(const SpeciesSpace& space, const SpeciesPoint& species) {
  return space.encoding->encode(species.values).choices;
}

/// Of a species on a map of two components.
SpeciesPoint moved(SpeciesPoint species, double x, double y) {
  species.coordinates = Eigen::Vector2d(x, y);
  return species;
}

/// A map of aspen, birch and palm at places that we choose.
SpeciesSpace three_on_a_map() {
  SpeciesSpace space = bundled_map();
  space.species = {moved(species_called(bundled_map(), "quaking_aspen"), 0, 0),
                   moved(species_called(bundled_map(), "silver_birch"), 4, 0),
                   moved(species_called(bundled_map(), "palm"), 0, 3)};
  return space;
}

TEST(ChoiceVotes, AreTheSpeciesOwnWhereItStands) {
  for (const SpeciesPoint& species : bundled_map().species)
    EXPECT_EQ(voted_choices(bundled_map(), species.coordinates), choices_of(bundled_map(), species))
        << species.name;
}

TEST(ChoiceVotes, WeighByTheInverseOfTheSquaredDistance) {
  const std::vector<double> weights = vote_weights(three_on_a_map(), Eigen::Vector2d(1, 0));
  const double sum = 1 + 1 / 9.0 + 1 / 10.0;
  EXPECT_NEAR(weights[0], 1 / sum, 1e-12);
  EXPECT_NEAR(weights[1], 1 / 9.0 / sum, 1e-12);
  EXPECT_NEAR(weights[2], 1 / 10.0 / sum, 1e-12);
}

TEST(ChoiceVotes, WeighAsMuchHoweverLargeTheMap) {
  SpeciesSpace space = three_on_a_map();
  const std::vector<double> weights = vote_weights(space, Eigen::Vector2d(1, 2));
  for (const double scale : {1e-200, 1e200}) {
    for (std::size_t i = 0; i < weights.size(); ++i)
      space.species[i].coordinates = scale * three_on_a_map().species[i].coordinates;
    const std::vector<double> scaled = vote_weights(space, scale * Eigen::Vector2d(1, 2));
    for (std::size_t i = 0; i < weights.size(); ++i) EXPECT_NEAR(scaled[i], weights[i], 1e-9) << scale;
  }
}

/// Halfway between aspen and birch, where the nearest preset once was the sphere tree, whose helix and leaves
/// the plant took.
TEST(ChoiceVotes, TakeNothingThatNeitherOfTheNearestTwoHas) {
  const SpeciesSpace& space = bundled_map();
  const Eigen::VectorXd middle = (species_called(space, "quaking_aspen").coordinates +
                                  species_called(space, "silver_birch").coordinates) /
                                 2;
  std::vector<SpeciesPoint> nearest = space.species;
  std::sort(nearest.begin(), nearest.end(), [&](const SpeciesPoint& a, const SpeciesPoint& b) {
    return (a.coordinates - middle).norm() < (b.coordinates - middle).norm();
  });
  const std::vector<double> voted = voted_choices(space, middle), first = choices_of(space, nearest[0]),
                            second = choices_of(space, nearest[1]);
  for (std::size_t i = 0; i < voted.size(); ++i) {
    const auto& choice = space.encoding->choices()[i];
    const auto has_none = [&](const SpeciesPoint& species) {
      return is_nothing(*space.encoding, space.encoding->encode(species.values), choice.row);
    };
    if (has_none(nearest[0]) && has_none(nearest[1])) continue;  // then the others alone know of it
    EXPECT_THAT(voted[i], testing::AnyOf(first[i], second[i])) << choice.name;
  }
}

TEST(ChoiceVotes, ADemonstrationHasNoneUnlessThereIsNothingElse) {
  SpeciesSpace space = three_on_a_map();
  space.species[0].demonstration = true;
  const std::vector<double> weights = vote_weights(space, Eigen::Vector2d(0, 0));
  EXPECT_EQ(weights[0], 0);
  EXPECT_NEAR(weights[1] + weights[2], 1, 1e-12);
  EXPECT_GT(weights[2], weights[1]);
  for (SpeciesPoint& species : space.species) species.demonstration = true;
  EXPECT_THAT(vote_weights(space, Eigen::Vector2d(0, 0)), testing::ElementsAre(1, 0, 0));
}

TEST(ChoiceVotes, ASpeciesWithoutThatLevelHasNoVoteOnItsSide) {
  SpeciesSpace space = three_on_a_map();  // palms have no fan of twigs, and no twigs
  const auto& choices = space.encoding->choices();
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const SpeciesPoint& palm = space.species[2];
    if (!is_nothing(*space.encoding, space.encoding->encode(palm.values), choices[i].row)) continue;
    const double voted = voted_choices(space, Eigen::Vector2d(0, 2.9))[i];
    EXPECT_THAT(
        voted, testing::AnyOf(choices_of(space, space.species[0])[i], choices_of(space, space.species[1])[i]))
        << choices[i].name;
  }
}

RC_GTEST_PROP(ChoiceVotes, DoNotDependOnTheOrderOfThePresets, ()) {
  SpeciesSpace shuffled = bundled_map();
  const Eigen::Vector2d point(*rc::gen::inRange(-1000, 1000) * 1e-2, *rc::gen::inRange(-1000, 1000) * 1e-2);
  for (std::size_t i = shuffled.species.size() - 1; i > 0; --i)
    std::swap(shuffled.species[i], shuffled.species[*rc::gen::inRange<std::size_t>(0, i + 1)]);
  RC_ASSERT(voted_choices(shuffled, point) == voted_choices(bundled_map(), point));
  const std::vector<double> weights = vote_weights(shuffled, point);
  RC_ASSERT(std::fabs(std::accumulate(weights.begin(), weights.end(), 0.0) - 1) < 1e-12);
}

}  // namespace
}  // namespace espalier
