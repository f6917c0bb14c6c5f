// Which files of the user's a run keeps, by which names, and that what comes with the program is not among
// them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include <espalier/fitting/run/run_files.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

std::string write_lines(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
  return path.string();
}

std::vector<std::string> names_of_files(const KeptFiles& kept) {
  std::vector<std::string> names;
  for (const RunFile& file : kept.files) names.push_back(file.name.string());
  return names;
}

KeptFiles kept_of(const FitRecord& record) { return files_to_keep(record, model_by_name(record.model)); }

TEST(RunFiles, WhatComesWithTheProgramIsOnlyNamed) {
  FitRecord record;
  record.start = "acer,apple", record.species = "palm";
  KeptFiles kept = kept_of(record);
  EXPECT_THAT(kept.files, ElementsAre());
  EXPECT_EQ(kept.record.start, "acer,apple");
  EXPECT_EQ(kept.record.species, "palm");
  record = {.model = "obstacle.lsys"};  // it reads a mesh of the program's
  record.start = "defaults";
  kept = kept_of(record);
  EXPECT_THAT(kept.files, ElementsAre());
  EXPECT_EQ(kept.record.model, "obstacle.lsys");
}

TEST(RunFiles, PresetsOfOneNameHaveTwoCopiesAndEqualOnesOne) {
  const fs::path folder = fresh_folder("run_files");
  const std::string left = write_lines(folder / "left/oak.toml", "extends = \"black_oak\"\ng_scale = 8\n"),
                    right = write_lines(folder / "right/oak.toml", "extends = \"black_oak\"\ng_scale = 9\n");
  FitRecord record;
  record.start = left + ",acer," + right, record.species = left;
  const KeptFiles kept = kept_of(record);
  EXPECT_THAT(names_of_files(kept), ElementsAre("presets/oak.toml", "presets/oak_2.toml"));
  EXPECT_EQ(kept.record.start, "presets/oak.toml,acer,presets/oak_2.toml");
  EXPECT_EQ(kept.record.species, "presets/oak.toml");
}

/// The user's L-system `name` in `folder`, of four files, two of which are those of another L-system that it
/// grows.
std::string write_bush(const fs::path& folder) {
  write_lines(folder / "berry.lsys", "include \"colors.lsys\"\naxiom: F(0.1)\n");
  write_lines(folder / "colors.lsys", "width: 0.1\n");
  write_lines(folder / "leaf.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  return write_lines(folder / "bush.lsys",
                     "param reach = 2 in 1 .. 3 \"of it\"\nplant berry = \"berry.lsys\"\n"
                     "surface leaf = \"leaf.obj\"\naxiom: F(reach)\n");
}

TEST(RunFiles, AnLSystemIsKeptWithAllThatItWasReadFrom) {
  const fs::path folder = fresh_folder("run_files");
  FitRecord record{.model = write_bush(folder / "models")};
  record.start = write_lines(folder / "models/low.toml", "model = \"bush.lsys\"\nreach = 1.25\n");
  const KeptFiles kept = kept_of(record);
  EXPECT_THAT(names_of_files(kept),
              testing::UnorderedElementsAre("model/bush.lsys", "model/berry.lsys", "model/colors.lsys",
                                            "model/leaf.obj", "presets/low.toml"));
  EXPECT_EQ(kept.record.model, "model/bush.lsys");
  keep_files(kept.files, folder / "run");
  fs::remove_all(folder / "models");
  const Preset low = load_preset((folder / "run/presets/low.toml").string());
  EXPECT_TRUE(is_same_model(low.model, (folder / "run/model/bush.lsys").string()));
  EXPECT_EQ(low.values[0], 1.25);
}

/// Keeps the files of a run of `record`, takes the folder of the user's away, and reads the run again.
void expect_same_when_read_again(const FitRecord& record, const fs::path& of_the_user, const fs::path& run) {
  const KeptFiles kept = kept_of(record);
  EXPECT_FALSE(kept.files.empty());
  keep_files(kept.files, run);
  write_lines(run / "run.toml", record_to_toml(kept.record, std::nullopt));
  fs::remove_all(of_the_user);
  const KeptFiles again = kept_of(read_record(run / "run.toml").record);
  EXPECT_EQ(again.files, kept.files);
  EXPECT_EQ(again.record.model, kept.record.model);
  EXPECT_EQ(again.record.start, kept.record.start);
  EXPECT_EQ(again.record.species, kept.record.species);
}

TEST(RunFiles, OfARunThatIsReadAgainAreTheSame) {
  const fs::path folder = fresh_folder("run_files"), models = folder / "models";
  FitRecord bushes{.model = write_bush(models), .views = {{"tree.png", {}}}};
  bushes.start = write_lines(models / "low.toml", "model = \"bush.lsys\"\nreach = 1.25\n");
  expect_same_when_read_again(bushes, models, folder / "bushes");
  FitRecord oaks{.views = {{"tree.png", {}}}};
  oaks.species = write_lines(models / "oak.toml", "extends = \"black_oak\"\ng_scale = 8\n");
  expect_same_when_read_again(oaks, models, folder / "oaks");
  FitRecord pines{.model = "small_pine.lsys", .views = {{"tree.png", {}}}};  // a bundled one
  pines.start = write_lines(models / "pine.toml", "model = \"small_pine.lsys\"\nbranch_angle = 60\n");
  expect_same_when_read_again(pines, models, folder / "pines");
}

}  // namespace
}  // namespace espalier
