// Each key of [pictures] and of [growth], from the tables of keys: what it takes, and one clear line for what
// it does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include <espalier/core/error.h>
#include <espalier/experiments/declaration/experiment_keys.h>

#include "support/object_files.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// A value that a key takes, and others of its type that it does not.
struct Sample {
  std::string good;
  std::vector<std::string> bad;
};
using Samples = std::map<std::string, Sample>;

const Samples kPictures{
    {"species", {"'acer'", {"'oak_of_nowhere'"}}},
    {"model", {"'palm'", {"'none'", "'none.lsys'"}}},
    {"rows", {"[{label = 'a'}]", {"[]", "['a']", "[{label = 'a'}, {label = 'a', t = 1}]"}}},
    {"columns", {"[{label = 'a'}]", {"[]", "[7]"}}},
    {"seed", {"7", {"-1", "1.5"}}},
    {"size", {"64", {"15", "5000"}}},
    {"frame_m", {"3.5", {"0", "-1", "inf"}}},
    {"view", {"'30,10'", {"'front'", "'0,91'"}}},
    {"ground", {"true", {"'yes'", "1"}}},
    {"objects", {"['mesh:box.obj']", {"['mesh:none.obj']", "['mesh:open.obj']", "['ball:0,0,0,1']", "[7]"}}},
};
const Samples kChanges{
    {"label", {"'a'", {"7"}}},
    {"species", {"'acer'", {"'oak_of_nowhere'"}}},
    {"model", {"'palm'", {"'none'"}}},
    {"blend_with", {"'acer'", {"'oak_of_nowhere'"}}},
    {"t", {"0.3", {"1.5", "nan"}}},
    {"set", {"{flare = 1}", {"7"}}},
    {"prune_to", {"'mesh:box.obj'", {"7"}}},
    {"objects",
     {"['mesh:box.obj']", {"['mesh:none.obj']", "['mesh:open.obj']", "['house.obj']", "'mesh:box.obj'"}}},
    {"season", {"'autumn'", {"'monsoon'", "''"}}},
    {"view", {"'90,0'", {"'from above'", "7"}}},
};
const Samples kGrowth{
    {"species", {"['acer']", {"[]", "['oak_of_nowhere']", "'acer'", "['acer', 'acer']"}}},
    {"models", {"['palm', {model = 'aspen'}]", {"[]", "['none']", "'palm'", "[7]", "['palm', 'palm.lsys']"}}},
    {"seeds", {"3", {"0", "1.5"}}},
};
const Samples kGrownModels{
    {"model", {"'palm'", {"'none'"}}},
    {"label", {"'fan palm'", {"7"}}},
};

fs::path study_with(const std::string& text) {
  const fs::path folder = fresh_folder("keys");
  write_box_obj(folder / "box.obj", {0, 0, 0}, {1, 1, 1});
  write_box_obj(folder / "open.obj", {0, 0, 0}, {1, 1, 1}, false);
  std::ofstream(folder / "study.toml") << text;
  return folder / "study.toml";
}

std::string refusal_of(const std::string& text) {
  try {
    read_experiment(study_with(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// The samples are those of the table; each good value is read, and each bad one refused by line and key.
void expect_read_and_refused(const std::vector<std::string>& keys, const Samples& samples,
                             const std::function<std::string(const std::string& line)>& text_of) {
  EXPECT_EQ(keys.size(), samples.size()) << "a key of the table has no sample";
  for (const std::string& key : keys) {
    const Sample& sample = samples.at(key);
    EXPECT_EQ(refusal_of(text_of(key + " = " + sample.good)), "no error") << key;
    std::vector<std::string> bad = sample.bad;
    bad.emplace_back("[[7.5]]");  // no key takes it
    for (const std::string& value : bad)
      EXPECT_THAT(refusal_of(text_of(key + " = " + value)),
                  AllOf(HasSubstr("study.toml:2: "), HasSubstr(key + ": "), HasSubstr("got "),
                        HasSubstr("expected ")))
          << key << " = " << value;
    EXPECT_THAT(
        refusal_of(text_of(key + "_ = 1")),
        AllOf(HasSubstr("study.toml:2: " + key + "_: got an unknown key"), HasSubstr("'" + key + "'")));
  }
}

/// The sheet needs a tree, below the line that is tested.
std::string sheet_with(const std::string& line) {
  const bool has_tree = line.starts_with("species =") || line.starts_with("model =");
  return "[pictures]\n" + line + "\n" + (has_tree ? "" : "species = 'palm'\n");
}

TEST(PictureAndGrowthKeys, OfPicturesAreReadAndRefused) {
  expect_read_and_refused(names_of(pictures_keys()), kPictures, sheet_with);
}

TEST(PictureAndGrowthKeys, OfRowsAndColumnsAreReadAndRefused) {
  for (const std::string list : {"rows", "columns"})
    expect_read_and_refused(names_of(change_keys()), kChanges, [&](const std::string& line) {
      return sheet_with(list + " = [{" + line + "}]");
    });
}

TEST(PictureAndGrowthKeys, OfGrowthAreReadAndRefused) {
  expect_read_and_refused(names_of(growth_keys()), kGrowth,
                          [](const std::string& line) { return "[growth]\n" + line + "\n"; });
}

TEST(PictureAndGrowthKeys, OfGrownModelsAreReadAndRefused) {
  expect_read_and_refused(names_of(grown_model_keys()), kGrownModels, [](const std::string& line) {
    return "[growth]\nmodels = [{" + line + (line.starts_with("model =") ? "" : ", model = 'palm'") + "}]\n";
  });
}

TEST(PictureAndGrowthKeys, ASheetHasOneTree) {
  EXPECT_THAT(refusal_of("[pictures]\nsize = 64\n"),
              AllOf(HasSubstr("species: got nothing"), HasSubstr("model")));
  EXPECT_THAT(refusal_of("[pictures]\nspecies = 'palm'\nmodel = 'palm'\n"),
              HasSubstr("study.toml:3: model: got 'palm', expected none beside a species"));
  EXPECT_THAT(refusal_of("[pictures]\nspecies = 'palm'\ncolumns = [{species = 'acer', model = 'palm'}]\n"),
              HasSubstr("study.toml:3: model: got 'palm', expected none beside a species"));
}

TEST(PictureAndGrowthKeys, WhatARowSetsIsAParameterOfEachColumn) {
  const std::string rows = "[pictures]\nmodel = 'palm'\nrows = [{set = {t_max = 200}}]\n";
  EXPECT_EQ(refusal_of(rows + "columns = [{label = 'a', set = {crown = 0.9}}]\n"), "no error");
  EXPECT_THAT(refusal_of(rows + "columns = [{label = 'a', model = 'aspen'}]\n"),
              HasSubstr("study.toml:4: columns: unknown parameter 't_max' of model aspen.lsys"));
  EXPECT_THAT(
      refusal_of("[pictures]\nmodel = 'palm'\ncolumns = [{blend_with = 'acer'}]\n"),
      AllOf(HasSubstr("study.toml:3: columns: got a blend of palm with acer"), HasSubstr("expected")));
}

TEST(PictureAndGrowthKeys, APresetLiesBesideTheExperiment) {
  const fs::path study = study_with("[pictures]\nspecies = 'own.toml'\ncolumns = [{species = 'own.toml'}]\n");
  std::ofstream(study.parent_path() / "own.toml") << "extends = 'palm'\n";
  EXPECT_EQ(read_experiment(study).pictures->species, (study.parent_path() / "own.toml").string());
  EXPECT_EQ(read_experiment(study).pictures->columns[0].species, (study.parent_path() / "own.toml").string());
}

TEST(PictureAndGrowthKeys, FilesOfTheBundledExperimentsAreFoundFromAnywhere) {
  EXPECT_EQ(refusal_of("[pictures]\nspecies = 'palm'\nobjects = ['mesh:volumes/house.obj']\n"), "no error");
  EXPECT_EQ(refusal_of(
                "[pictures]\nspecies = 'palm'\ncolumns = [{prune_to = 'mesh:volumes/beside_a_house.obj'}]\n"),
            "no error");
}

/// A study that has pictures keeps them: what changes one is refused.
TEST(PictureAndGrowthKeys, NoKeyMayChangeWhatIsDrawn) {
  const auto study = [](const std::string& line) { return read_experiment(study_with(sheet_with(line))); };
  const Experiment was = study("seed = 1");
  for (const std::string& key : names_of(pictures_keys())) {
    if (key == "model" || key == "rows" || key == "columns") continue;  // instead of the species; may grow
    EXPECT_THAT(change_of_runs(was, study(key + " = " + kPictures.at(key).good)),
                testing::StartsWith(key + ": got "));
  }
  const Experiment column = study("columns = [{label = 'a'}]");
  for (const std::string& key : names_of(change_keys())) {
    if (key == "label" || key == "t") continue;  // t is read with blend_with
    EXPECT_THAT(change_of_runs(
                    column, study("columns = [{label = 'a', " + key + " = " + kChanges.at(key).good + "}]")),
                testing::StartsWith("columns: got "))
        << key;
  }
}

}  // namespace
}  // namespace espalier
