// Laws of the evidence for species: probabilities, and that trees of a species are taken for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include <espalier/fitting/starts/species_evidence.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

using testing::HasSubstr;

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(Probabilities, AddUpToOneAndFallWithTheExcess) {
  const std::vector<double> found = probabilities_of(std::vector<double>{0.01, 0.03, 0.0, 0.08}, 0.02);
  EXPECT_NEAR(sum_of(found), 1, 1e-12);
  EXPECT_GT(found[2], found[0]);
  EXPECT_GT(found[0], found[1]);
  EXPECT_GT(found[1], found[3]);
  EXPECT_NEAR(found[1] / found[2], std::exp(-0.5 * 1.5 * 1.5), 1e-12);
  EXPECT_TRUE(probabilities_of({}, 0.02).empty());
}

TEST(Probabilities, MoreAlikeThanItsOwnTreesIsNoMoreThanAlike) {
  const std::vector<double> found = probabilities_of(std::vector<double>{-0.05, 0.0}, 0.02);
  EXPECT_EQ(found[0], found[1]);
}

TEST(Probabilities, WhatIsUnlikeAllSpeciesSaysLittle) {
  const std::vector<double> near = probabilities_of(std::vector<double>{0.0, 0.05}, 0.02),
                            far = probabilities_of(std::vector<double>{0.2, 0.25}, 0.02);
  EXPECT_GT(near[0], 0.95);
  EXPECT_LT(far[0], 0.65);
  EXPECT_GT(far[0], 0.5);
}

/// A picture of a tree of this species, and the task of fitting it.
struct Portrait {
  FitRecord record;
  FitTask task;
};

Portrait portrait_of(const std::string& species, Seed seed) {
  const Preset preset = load_preset(species);
  Portrait portrait;
  Plant plant;
  const Model& model = model_by_name("weber_penn");
  model.generate(preset.values, seed, {}, plant);
  Mask mask;
  make_scanline_renderer()->draw(plant, frame_bounds(bounds(plant), {}, 128, 128), mask);
  const auto path = fresh_folder("portrait") / (species + ".png");
  write_mask_png(path, mask);
  portrait.record.views = {{path, {}}};
  portrait.record.target.size_px = 64;
  portrait.record.growth = {2'000, 20'000};
  portrait.record.kind = KindChoice::automatic;
  portrait.task = make_task(portrait.record);
  return portrait;
}

std::vector<SpeciesEvidence> evidence_of(const Portrait& portrait) {
  return species_evidence(portrait.record, portrait.task, plan_of(portrait.record, portrait.task));
}

TEST(SpeciesEvidence, OfSpeciesThatLookLikeNoOtherIsForThem) {
  for (const char* species : {"lombardy_poplar", "small_pine", "weeping_willow"}) {
    const std::vector<SpeciesEvidence> evidence = evidence_of(portrait_of(species, 101));
    ASSERT_FALSE(evidence.empty());
    EXPECT_EQ(evidence.front().species.name, species);
    double sum = 0;
    for (std::size_t i = 0; i < evidence.size(); ++i) {
      sum += evidence[i].probability;
      EXPECT_LE(evidence[i].probability, evidence[i == 0 ? 0 : i - 1].probability);
    }
    EXPECT_NEAR(sum, 1, 1e-9);
  }
}

TEST(SpeciesEvidence, OfAPalmIsAmongPalms) {
  for (const SpeciesEvidence& row : evidence_of(portrait_of("palm", 7)))
    EXPECT_THAT(model_by_name("weber_penn").palm_presets(), testing::Contains(row.species.name));
}

TEST(SpeciesEvidence, InWordsNamesTheLikely) {
  EXPECT_EQ(species_in_words({}, 1), "");
  const std::vector<SpeciesEvidence> evidence = {
      {{"apple", {}}, 0.3, 0.2, 0.85}, {{"fir", {}}, 0.4, 0.2, 0.11}, {{"palm", {}}, 0.5, 0.2, 0.04}};
  EXPECT_EQ(species_in_words(evidence, 0.8),
            "looks like apple (85 %), fir (11 %); its parameters are 0.80 spreads of species from apple");
}

}  // namespace
}  // namespace espalier
