// The space of the bundled presets: what it holds and leaves out, points of it, and the file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <fstream>
#include <numeric>

#include <espalier/core/error.h>
#include <espalier/fitting/species_space/preset_collection.h>
#include <espalier/fitting/species_space/species_space.h>
#include <espalier/fitting/species_space/species_space_file.h>
#include <espalier/models/models.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

SpeciesSpace bundled_space(int components, const std::string& encoding = "monotone") {
  return make_species_space(load_presets({}), encoding, components);
}

/// Rows that are choices alone always mean something here.
bool row_means(const Encoding& encoding, const EncodedValues& encoded, std::size_t row) {
  bool has_columns = false, means = false;
  for (std::size_t i = 0; i < encoded.means.size(); ++i)
    if (encoding.columns()[i].row == row) has_columns = true, means = means || encoded.means[i];
  return means || !has_columns;
}

std::string space_error(const std::vector<Preset>& presets, int components) {
  try {
    make_species_space(presets, "monotone", components);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// Bundled presets, the first two with crowns of these radii to the left.
std::vector<Preset> with_crowns(double first_radius, double second_radius) {
  std::vector<Preset> presets = load_presets({"quaking_aspen", "silver_birch", "apple"});
  const ParameterTable& table = model_by_name("weber_penn").table();
  for (const auto& [i, radius] : {std::pair{0, first_radius}, std::pair{1, second_radius}}) {
    ParameterValues& values = presets[static_cast<std::size_t>(i)].values;
    values[table.index_of("crown_use")] = 2;
    values[table.index_of("crown_radius_left")] = radius;
  }
  return presets;
}

bool has_column(const SpeciesSpace& space, const std::string& name) {
  return std::any_of(space.encoding->columns().begin(), space.encoding->columns().end(),
                     [&](const EncodingColumn& column) { return column.name == name; });
}

TEST(SpeciesSpace, HasNoColumnsOfWhatAllSpeciesLack) {
  for (const char* encoding : {"raw", "monotone"}) {
    EXPECT_FALSE(has_column(bundled_space(2, encoding), "crown_radius_left")) << encoding;
    EXPECT_TRUE(has_column(make_species_space(with_crowns(0.2, 0.4), encoding, 1), "crown_radius_left"));
  }
}

TEST(SpeciesSpace, CrownsOfItsSpeciesAreKeptAndReadBackFromAFile) {
  const SpeciesSpace space = make_species_space(with_crowns(0.2, 0.4), "monotone", 2);
  const std::size_t row = space.model->table().index_of("crown_radius_left");
  for (const std::size_t i : {0, 1})
    EXPECT_NEAR(plant_at(space, space.species[i].coordinates).values[row], i == 0 ? 0.2 : 0.4, 1e-9);
  for (const auto& [presets, listed] : {std::pair{with_crowns(0.2, 0.4), true}, {load_presets({}), false}}) {
    const SpeciesSpace written = make_species_space(presets, "monotone", 2);
    const std::string text = species_space_to_toml(written);
    EXPECT_EQ(text.find("crown_radius_left") != std::string::npos, listed);
    const auto file = fresh_folder("crowns") / "space.toml";
    std::ofstream(file) << text;
    const SpeciesSpace read = read_species_space(file);
    EXPECT_EQ(species_space_to_toml(read), text);
    for (std::size_t i = 0; i < read.species.size(); ++i)
      EXPECT_EQ(read.species[i].values, written.species[i].values);
  }
}

TEST(SpeciesSpace, AllComponentsHoldEverySpecies) {
  for (const char* encoding : {"raw", "monotone"}) {
    const SpeciesSpace space = bundled_space(17, encoding);
    for (const double error : reconstruction_error(space).of_species) EXPECT_LT(error, 1e-9);
    for (const SpeciesPoint& species : space.species) {
      const PlantAtPoint plant = plant_at(space, species.coordinates);
      EXPECT_EQ(plant.nearest, species.name);
      EXPECT_LT(plant.outside, 1e-4);
      const EncodedValues wanted = space.encoding->encode(species.values),
                          got = space.encoding->encode(plant.values);
      for (std::size_t i = 0; i < wanted.choices.size(); ++i)
        if (row_means(*space.encoding, wanted, space.encoding->choices()[i].row)) {
          EXPECT_EQ(got.choices[i], wanted.choices[i])
              << species.name << " " << space.encoding->choices()[i].name;
        }
      for (std::size_t i = 0; i < wanted.numbers.size(); ++i)
        EXPECT_NEAR(wanted.means[i] ? got.numbers[i] : wanted.numbers[i], wanted.numbers[i],
                    1e-9 * std::max(1.0, std::fabs(wanted.numbers[i])))
            << encoding << " " << species.name << " " << space.encoding->columns()[i].name;
    }
  }
}

TEST(SpeciesSpace, TwoComponentsLeaveSomethingOutAndSaySo) {
  const ReconstructionError error = reconstruction_error(bundled_space(2));
  for (const double of_species : error.of_species) EXPECT_GT(of_species, 0.1);
  EXPECT_THAT(error.constant_columns, testing::Contains("tropism_x"));
}

TEST(SpeciesSpace, MoreComponentsLeaveLessOut) {
  double before = 1e9;
  for (const int count : {1, 2, 5, 10, 17}) {
    const std::vector<double> errors = reconstruction_error(bundled_space(count)).of_species;
    const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
    EXPECT_LT(sum, before);
    before = sum;
  }
}

TEST(SpeciesSpace, APointFarOutIsClampedAndSaysHowFar) {
  const SpeciesSpace space = bundled_space(2);
  const PlantAtPoint inside = plant_at(space, Eigen::Vector2d(0, 0));
  EXPECT_EQ(inside.outside, 0);
  EXPECT_TRUE(inside.clamped.empty());
  const PlantAtPoint outside = plant_at(space, Eigen::Vector2d(0, 1000));
  EXPECT_NEAR(outside.outside, 990, 10);
  EXPECT_GT(outside.clamped.size(), 10u);
  for (const ClampedValue& clamped : outside.clamped)
    EXPECT_NE(clamped.wanted, clamped.got) << clamped.parameter;
}

RC_GTEST_PROP(SpeciesSpace, EveryPointIsAValidPlant, ()) {
  static const SpeciesSpace kMonotone = bundled_space(2), kRaw = bundled_space(2, "raw");
  const Eigen::Vector2d point(*rc::gen::inRange(-4000, 4000) * 1e-2, *rc::gen::inRange(-4000, 4000) * 1e-2);
  for (const SpeciesSpace* space : {&kMonotone, &kRaw}) {
    const ParameterValues values = plant_at(*space, point).values;
    for (std::size_t row = 0; row < values.size(); ++row)
      check_value(space->model->table().rows[row], values[row], "point");
  }
}

TEST(SpeciesSpace, APlantMovedToWhereItIsStaysItself) {
  const SpeciesSpace space = bundled_space(2);
  for (const SpeciesPoint& species : space.species) {
    EXPECT_EQ(plant_moved_to(space, species.values, species.coordinates).values, species.values);
    const Eigen::Vector2d away = species.coordinates + Eigen::Vector2d(0.5, -0.5);
    EXPECT_NE(plant_moved_to(space, species.values, away).values, species.values);
  }
}

TEST(SpeciesSpace, TheFileKeepsEveryBit) {
  const SpeciesSpace space = bundled_space(3);
  const std::string text = species_space_to_toml(space);
  const auto file = fresh_folder("space") / "space.toml";
  std::ofstream(file) << text;
  const SpeciesSpace read = read_species_space(file);
  EXPECT_EQ(species_space_to_toml(read), text);
  EXPECT_EQ(read.pca.components, space.pca.components);
  EXPECT_EQ(read.pca.mean, space.pca.mean);
  EXPECT_EQ(read.species[4].values, space.species[4].values);
  const Eigen::Vector3d point(0.8, -1.2, 3);
  EXPECT_EQ(plant_at(read, point).values, plant_at(space, point).values);
}

TEST(SpeciesSpace, TheFileKeepsWhatIsADemonstration) {
  const SpeciesSpace space = make_species_space(load_presets({"sphere_tree", "palm", "acer"}), "monotone", 1);
  const auto file = fresh_folder("space") / "space.toml";
  std::ofstream(file) << species_space_to_toml(space);
  const SpeciesSpace read = read_species_space(file);
  EXPECT_TRUE(read.species[0].demonstration);
  EXPECT_FALSE(read.species[1].demonstration);
}

TEST(SpeciesSpace, RefusesPresetsThatSpanNothing) {
  const Preset aspen = load_preset("quaking_aspen"), birch = load_preset("silver_birch");
  EXPECT_THAT(space_error({aspen}, 1), HasSubstr("got 1, expected at least 2"));
  EXPECT_THAT(space_error({aspen, aspen}, 1), HasSubstr("the same values"));
  EXPECT_THAT(space_error({aspen, birch}, 2), HasSubstr("components: got 2, expected 1 … 1"));
  Preset other = birch;
  other.model = "lsystem";
  EXPECT_THAT(space_error({aspen, other}, 1), HasSubstr("expected one model"));
}

TEST(SpeciesSpace, CurvesThatNoPresetUsesHaveNoColumns) {
  const SpeciesSpace space = bundled_space(2);
  for (const EncodingColumn& column : space.encoding->columns())
    EXPECT_LT(column.row, space.model->table().curves.front().first_row) << column.name;
  EXPECT_EQ(species_space_to_toml(space).find("_along"), std::string::npos);
}

TEST(SpeciesSpace, AnUnusedCurveOfAPlantStaysAsItIsMoved) {
  const SpeciesSpace space = bundled_space(2);
  ParameterValues values = space.species[0].values;
  const std::size_t row = space.model->table().index_of("length_along[1].3");
  values[row] = 1.75;
  EXPECT_EQ(plant_moved_to(space, values, space.species[1].coordinates).values[row], 1.75);
}

TEST(SpeciesSpace, ACurveThatAPresetUsesIsPartOfIt) {
  std::vector<Preset> presets = load_presets({"acer", "apple", "palm"});
  const std::size_t row = model_by_name("weber_penn").table().index_of("length_along[1].3");
  presets[1].values[row] = 0.25;
  const SpeciesSpace space = make_species_space(presets, "monotone", 2);
  const fs::path file = fresh_folder("curves") / "space.toml";
  std::ofstream(file) << species_space_to_toml(space);
  const SpeciesSpace again = read_species_space(file);
  for (const SpeciesPoint& species : again.species)
    EXPECT_NEAR(plant_at(again, species.coordinates).values[row], species.values[row], 1e-9) << species.name;
  EXPECT_EQ(again.species[1].values, presets[1].values);
  EXPECT_EQ(species_space_to_toml(again), species_space_to_toml(space));
}

}  // namespace
}  // namespace espalier
