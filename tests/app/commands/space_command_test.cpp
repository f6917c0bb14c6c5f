// `espalier space`: the map, the sheet, the saved space, what is printed, and bad input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <espalier/image/pictures/decode.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

std::string path_in(const std::string& name) {
  static const fs::path kFolder = fresh_folder("space_command");
  return (kFolder / name).string();
}

void write_preset(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(SpaceCommand, PrintsWhatIsExplainedAndWhatIsLeftOut) {
  const ProgramRun run = run_espalier("space");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("18 presets of weber_penn, encoding monotone, 2 of 17 components\n"));
  EXPECT_THAT(run.out, HasSubstr("of the variance"));
  EXPECT_THAT(run.out, HasSubstr("\nquaking_aspen "));
  EXPECT_THAT(run.out, HasSubstr("least well held:"));
  EXPECT_THAT(run.out, HasSubstr("the same in all, carried as they are: "));
}

TEST(SpaceCommand, ADemonstrationIsOnTheMapOnlyByName) {
  EXPECT_THAT(run_espalier("space").out, testing::Not(HasSubstr("sphere_tree")));
  const ProgramRun named = run_espalier("space --components 1 --presets palm,acer,sphere_tree");
  EXPECT_EQ(named.exit_code, 0) << named.err;
  EXPECT_THAT(named.out, StartsWith("3 presets"));
  EXPECT_THAT(named.out, HasSubstr("\nsphere_tree "));
}

TEST(SpaceCommand, DrawsTheMapAsSvgAndPng) {
  const std::string presets = "--presets palm,acer,quaking_aspen ";
  ASSERT_EQ(run_espalier("space " + presets + path_in("map.svg")).exit_code, 0);
  const std::string svg = read_text_file(path_in("map.svg"));
  EXPECT_THAT(svg, StartsWith("<svg "));
  EXPECT_THAT(svg, HasSubstr(">quaking_aspen</text>"));
  EXPECT_THAT(svg, HasSubstr("data:image/png;base64,iVBORw0KGgo"));
  ASSERT_EQ(run_espalier("space " + presets + path_in("map.png")).exit_code, 0);
  EXPECT_GT(fs::file_size(path_in("map.png")), 10'000u);
}

TEST(SpaceCommand, DrawsASheetOfThePlane) {
  const ProgramRun run = run_espalier("space --grid 3x2 --tile 32 " + path_in("sheet.png"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const DecodedPicture sheet = decode_picture(path_in("sheet.png"));
  EXPECT_EQ(sheet.width_px, 3 * 32 + 2 * 4);
  EXPECT_EQ(sheet.height_px, 2 * (32 + 24));
}

TEST(SpaceCommand, ASavedSpaceGivesTheSamePlant) {
  ASSERT_EQ(run_espalier("space --save " + path_in("space.toml")).exit_code, 0);
  const std::string at = "blend --at 0.8,-1.2 -o ";
  ASSERT_EQ(run_espalier(at + path_in("here.toml")).exit_code, 0);
  ASSERT_EQ(run_espalier(at + path_in("saved.toml") + " --space " + path_in("space.toml")).exit_code, 0);
  std::string saved = read_text_file(path_in("saved.toml"));
  saved.replace(saved.find("\"saved\""), 7, "\"here\"");
  EXPECT_EQ(saved, read_text_file(path_in("here.toml")));
}

TEST(SpaceCommand, TakesAFolderOfPresetsAndRuns) {
  write_preset(path_in("mine/a.toml"), "extends = \"palm\"\n");
  write_preset(path_in("mine/run-1/best.toml"), "extends = \"acer\"\n");
  const ProgramRun run = run_espalier("space --components 1 --presets " + path_in("mine"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("2 presets"));
  EXPECT_THAT(run.out, HasSubstr("\nrun-1 "));
}

TEST(SpaceCommand, BadInputIsOneLine) {
  write_preset(path_in("one/a.toml"), "extends = \"palm\"\n");
  write_preset(path_in("twins/a.toml"), "extends = \"palm\"\n");
  write_preset(path_in("twins/b.toml"), "extends = \"palm\"\n");
  write_preset(path_in("other/a.toml"), "extends = \"palm\"\n");
  write_preset(path_in("other/b.toml"), "model = \"lsystem\"\n");
  write_preset(path_in("no_space.toml"), "format = 1\nmodel = \"weber_penn\"\nencoding = \"raw\"\n");
  fs::create_directories(path_in("empty"));
  const std::pair<std::string, std::string> cases[] = {
      {"--presets " + path_in("one"), "expected at least 2"},
      {"--presets " + path_in("twins"), "the same values in all columns"},
      {"--presets " + path_in("other"), "got model 'lsystem'"},
      {"--presets " + path_in("empty"), "without presets"},
      {"--presets nowhere,palm", "got preset 'nowhere'"},
      {"--components 18", "--components: got 18, expected 1 … 17"},
      {"--components 0", "--components"},
      {"--components two", "--components"},
      {"--encoding log", "got 'log', expected raw or monotone"},
      {"--grid 7 " + path_in("x.png"), "--grid: got '7'"},
      {"--grid 0x7 " + path_in("x.png"), "--grid: got '0x7'"},
      {"--grid 7x7", "expected a PNG"},
      {"--grid 7x7 " + path_in("x.svg"), ".png"},
      {path_in("map.jpg"), ".png"},
      {"/nowhere/map.svg", "/nowhere"},
      {"--space " + path_in("no_space.toml"), "'parameters': got nothing"},
      {"--space " + path_in("missing.toml"), "no such file"}};
  for (const auto& [arguments, message] : cases) {
    const ProgramRun run = run_espalier("space " + arguments);
    SCOPED_TRACE(arguments);
    expect_one_clear_error(run);
    EXPECT_THAT(run.err, HasSubstr(message));
  }
  EXPECT_FALSE(fs::exists(path_in("x.png")));
}

}  // namespace
}  // namespace espalier
