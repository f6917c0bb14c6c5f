// A species space from presets or from a file, with as many components as asked for.
#include <gtest/gtest.h>

#include <fstream>

#include <espalier/app/options/space_options.h>
#include <espalier/core/error.h>
#include <espalier/fitting/species_space/species_space_file.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

TEST(SpaceOptions, AFewPresetsMakeASpaceOfTheComponentsAskedFor) {
  SpaceOptions options;
  options.presets = {"palm", "acer", "bamboo", "quaking_aspen"};
  EXPECT_EQ(load_space(options, 0).dimension(), 2);
  EXPECT_EQ(load_space(options, 3).dimension(), 3);
}

TEST(SpaceOptions, ASavedSpaceKeepsItsComponents) {
  SpaceOptions options;
  options.presets = {"palm", "acer", "bamboo", "quaking_aspen"};
  const auto file = fresh_folder("space_options") / "space.toml";
  std::ofstream(file) << species_space_to_toml(load_space(options, 3));
  SpaceOptions saved;
  saved.file = file.string();
  EXPECT_EQ(load_space(saved, 0).dimension(), 3);
  EXPECT_EQ(load_space(saved, 3).dimension(), 3);
  EXPECT_THROW(load_space(saved, 2), InputError);
}

}  // namespace
}  // namespace espalier
