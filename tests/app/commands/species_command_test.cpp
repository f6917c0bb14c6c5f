// What `espalier species` prints, and how it answers bad presets: exit code 2 and one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include <espalier/models/grow_preset.h>
#include <espalier/models/preset.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Checks one bad preset file of this content.
void expect_refused(const std::string& content, const std::string& message) {
  const fs::path folder = fresh_folder("species");
  std::ofstream(folder / "my.toml", std::ios::binary) << content;
  const ProgramRun run = run_espalier("species --check '" + (folder / "my.toml").string() + "'");
  expect_one_clear_error(run);
  EXPECT_THAT(run.err, HasSubstr(message));
  fs::remove_all(folder);
}

TEST(SpeciesCommand, TheHeightOfOneTreeIsThatOfTheTreeThatGrows) {
  const fs::path folder = fresh_folder("one_tree");
  std::ofstream(folder / "one.toml") << "extends = \"palm\"\nseed = 3\ng_scale = 10\ng_scale_v = 0\n";
  const std::string out = run_espalier("species --check '" + (folder / "one.toml").string() + "'").out;
  const Bounds box = bounds(grow_preset(load_preset((folder / "one.toml").string()), "one"));
  EXPECT_THAT(out, HasSubstr(fmt::format(", height {:.2f} m\n", box.upper.z - box.lower.z)));
}

TEST(SpeciesCommand, ListsAsJson) {
  const auto species = nlohmann::json::parse(run_espalier("species --json").out);
  EXPECT_EQ(species.size(), 19u + 6u);
  EXPECT_EQ(nlohmann::json::parse(run_espalier("lsystem --json").out)[0].size(), 2u);
}

TEST(SpeciesCommand, ListsEveryBundledPresetOnALine) {
  const ProgramRun run = run_espalier("species");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 19 + 2 + 6 + 2)
      << "species, a heading, designs, where L-systems are";
  EXPECT_THAT(run.out, HasSubstr("quaking_aspen       13 ± 3 m     Quaking aspen (Populus tremuloides)\n"));
  EXPECT_THAT(run.out, HasSubstr("\n\nDesigned branch by branch, and no species:\nbonsai_bunjin"));
}

TEST(SpeciesCommand, PrintsTheDecompositionGraphOfADesign) {
  const ProgramRun run = run_espalier("species bonsai_nejikan");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out,
              HasSubstr("# 0: axis of 10 points in the frame of the parent\n#   0/7: shares left\n"));
  EXPECT_THAT(run.out, testing::Not(HasSubstr("dormant")));
}

TEST(SpeciesCommand, PrintsAPresetThatLoadsBackWithUnitsAndHelp) {
  const ProgramRun run = run_espalier("species weeping_willow");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("# deg: angle of a stem away from its parent"));
  const fs::path file = fresh_folder("species") / "printed.toml";
  std::ofstream(file) << run.out;
  EXPECT_EQ(load_preset(file.string()).values, load_preset("weeping_willow").values);
}

TEST(SpeciesCommand, PrintsAFileLikeABundledPreset) {
  const std::string file = ESPALIER_SOURCE_DIR "/src/weber_penn/species/acer.toml";
  EXPECT_EQ(run_espalier("species '" + file + "'").out, run_espalier("species acer").out);
}

TEST(SpeciesCommand, CheckSaysOk) {
  const ProgramRun run =
      run_espalier("species --check " ESPALIER_SOURCE_DIR "/src/weber_penn/species/palm.toml");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, testing::StartsWith("ok "));
}

TEST(SpeciesCommand, RefusesAnUnknownName) {
  const ProgramRun run = run_espalier("species quaking_aspn");
  expect_one_clear_error(run);
  EXPECT_THAT(run.err, HasSubstr("the closest is 'quaking_aspen'"));
}

TEST(SpeciesCommand, RefusesAMissingFile) { expect_one_clear_error(run_espalier("species --check no.toml")); }

TEST(SpeciesCommand, RefusesADirectory) { expect_one_clear_error(run_espalier("species --check /tmp/")); }

TEST(SpeciesCommand, RefusesADevice) { expect_one_clear_error(run_espalier("species --check /dev/zero")); }

TEST(SpeciesCommand, RefusesAnEmptyFile) { expect_refused("", "got an empty file"); }

TEST(SpeciesCommand, RefusesABinaryFile) {
  expect_refused(std::string("\x89PNG\0\0\0\n\n\xff\xfe", 11), "got a binary file");
}

TEST(SpeciesCommand, RefusesBytesThatAreNoText) { expect_refused("\xff\xfe\xfd\n\x01\x02", "got bad TOML"); }

TEST(SpeciesCommand, RefusesAHugeFile) {
  expect_refused(std::string(2'000'000, '#'), "got more than 1000000 bytes");
}

TEST(SpeciesCommand, RefusesNaN) {
  expect_refused("model = \"weber_penn\"\ng_scale = nan\n", "my.toml:2: key 'g_scale': got nan, expected");
}

TEST(SpeciesCommand, RefusesInfinity) {
  expect_refused("model = \"weber_penn\"\ng_scale = inf\n", "my.toml:2: key 'g_scale': got inf, expected");
}

TEST(SpeciesCommand, RefusesNumbersAsLargeAsDoublesGet) {
  expect_refused("model = \"weber_penn\"\ng_scale = 1e308\n",
                 "my.toml:2: key 'g_scale': got 1e+308, expected");
}

TEST(SpeciesCommand, RefusesNineLevels) {
  expect_refused("model = \"weber_penn\"\nlevels = 9\n", "my.toml:2: key 'levels': got 9, expected");
}

TEST(SpeciesCommand, RefusesABillionBranches) {
  expect_refused("model = \"weber_penn\"\nbranches = [1, 1e9]\n",
                 "my.toml:2: key 'branches[1]': got 1000000000");
}

TEST(SpeciesCommand, RefusesDeepNestingWithoutACrash) {
  expect_refused("a = " + std::string(400'000, '[') + "\n",
                 "my.toml:1: got keys, tables or arrays nested more than 100 deep");
}

}  // namespace
}  // namespace espalier
