// `espalier target`: what it writes and says, and that bad input is one line, exit code 2, and no file.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include <espalier/image/pictures/picture.h>
#include <espalier/image/reading/read_target.h>

#include "support/picture_files.h"
#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string quoted(const fs::path& path) { return fmt::format("\'{}\'", path.string()); }

class TargetCommand : public testing::Test {
 protected:
  ~TargetCommand() override { fs::remove_all(folder_); }

  fs::path folder_ = fresh_folder("target_command");
  const std::string fir_ = quoted(ESPALIER_SOURCE_DIR "/targets/fir.png");
};

TEST_F(TargetCommand, WritesTheMaskThatAFitSeesAndSaysHow) {
  const ProgramRun run = run_espalier("target " + fir_ + " -o " + quoted(folder_ / "mask.png"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("alpha above 0.5"));
  EXPECT_THAT(run.out, HasSubstr("256×256 px, the tree is 235.5 px tall"));
  EXPECT_EQ(read_mask(folder_ / "mask.png").mask, read_target(ESPALIER_SOURCE_DIR "/targets/fir.png").mask);
}

TEST_F(TargetCommand, TakesSizeMethodAndSide) {
  test::write_samples(folder_ / "a.png", test::draw_tree(100, {.2f, .5f, .2f}, {.9f, .9f, .9f}));
  const ProgramRun run =
      run_espalier("target " + quoted(folder_ / "a.png") + " -o " + quoted(folder_ / "mask.png") +
                   " --size 64 --method luminance --side dark --speck 0 --fill-pinholes");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("luminance below"));
  EXPECT_THAT(run.out, HasSubstr("pinholes"));
  EXPECT_EQ(read_mask(folder_ / "mask.png").mask.width_px(), 64);
}

TEST_F(TargetCommand, SaysWhatATrunkStandsOn) {
  Mask island(200, 220);
  for (int y = 10; y < 210; ++y) {
    const int half_px = y < 120 ? 50 : y < 180 ? 7 : y < 205 ? 30 : 15;
    for (int x = 100 - half_px; x < 100 + half_px; ++x) island.set(x, y);
  }
  write_mask_png(folder_ / "island.png", island);
  const std::string output = " -o " + quoted(folder_ / "mask.png");
  EXPECT_THAT(run_espalier("target " + quoted(folder_ / "island.png") + output).out,
              HasSubstr("on a mound, pot or stand 0."));
  EXPECT_THAT(run_espalier("target " + fir_ + output).out, Not(HasSubstr("stand 0.")));
}

class TargetCommandBadPicture : public testing::TestWithParam<test::BadPicture> {};

TEST_P(TargetCommandBadPicture, IsOneLineAndNoFile) {
  const fs::path folder = fresh_folder("target_bad");
  GetParam().write(folder / GetParam().file);
  const ProgramRun run =
      run_espalier("target " + quoted(folder / GetParam().file) + " -o " + quoted(folder / "mask.png"));
  expect_one_clear_error(run);
  EXPECT_THAT(run.err, HasSubstr(GetParam().message));
  EXPECT_FALSE(fs::exists(folder / "mask.png"));
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Pictures, TargetCommandBadPicture, testing::ValuesIn(test::bad_pictures()),
                         [](const auto& info) {
                           std::string name = info.param.file;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

class TargetCommandBadArguments : public testing::TestWithParam<const char*> {};

TEST_P(TargetCommandBadArguments, AreOneLineAndNoFile) {
  const fs::path folder = fresh_folder("target_arguments");
  const ProgramRun run =
      run_shell("cd " + quoted(folder) +
                " && '" ESPALIER_PROGRAM "' target '" ESPALIER_SOURCE_DIR "/targets/fir.png' " + GetParam());
  expect_one_clear_error(run);
  EXPECT_TRUE(fs::is_empty(folder));
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Arguments, TargetCommandBadArguments,
                         testing::Values("", "-o mask.png --size 0", "-o mask.png --size 5000",
                                         "-o mask.png --size nan", "-o mask.png --size 1e308",
                                         "-o mask.png --method magic", "-o mask.png --side left",
                                         "-o mask.png --speck -2", "-o missing/mask.png", "-o .",
                                         "-o /dev/full", "-o /proc/mask.png", "-o mask.png --unknown"));

TEST_F(TargetCommand, ADiskThatFillsUpLeavesTheOldFile) {
  test::write_bytes(folder_ / "mask.png", "old");
  const ProgramRun run =
      run_shell("(trap '' XFSZ; ulimit -f 0; '" ESPALIER_PROGRAM "' target " + fir_ + " -o " +
                quoted(folder_ / "mask.png") + "; echo exit code $?) 2>&1 | cat >&2");
  EXPECT_THAT(run.err, HasSubstr("cannot be written"));
  EXPECT_THAT(run.err, HasSubstr("exit code 2"));
  EXPECT_EQ(read_text_file(folder_ / "mask.png"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

/// A trunk and a crown that is cut off above: a fit and the command both say so, a line each.
TEST_F(TargetCommand, WarningsOfAPictureGoToStderr) {
  Mask mask(128, 128);
  for (int y = 0; y < 120; ++y)
    for (int x = y < 70 ? 44 : 60; x < (y < 70 ? 84 : 68); ++x) mask.set(x, y);
  const fs::path picture = folder_ / "cut.png";
  write_mask_png(picture, mask);
  const std::string warning =
      fmt::format("espalier: warning: {}: the tree runs into the upper", picture.string());
  const ProgramRun fitted =
      run_espalier(fmt::format("fit {} --evaluations 5 --branch-rounds 0 --size 32 --start palm --out {}",
                               quoted(picture), quoted(folder_ / "run")));
  EXPECT_EQ(fitted.exit_code, 0) << fitted.err;
  EXPECT_THAT(fitted.err, HasSubstr(warning));
  EXPECT_THAT(run_espalier(fmt::format("target {} -o /dev/null", quoted(picture))).err, HasSubstr(warning));
}

/// The fir is green: its labels are a picture of leaves, and the command says how they were told.
TEST_F(TargetCommand, LabelsAreWrittenAndExplained) {
  const fs::path labels = folder_ / "labels.png";
  const ProgramRun run = run_espalier(fmt::format("target {} -o {} --size 64 --labels {}", fir_,
                                                  quoted(folder_ / "mask.png"), quoted(labels)));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("leaves by their green"));
  EXPECT_TRUE(fs::exists(labels));
  const ProgramRun refused = run_espalier(
      fmt::format("target {} -o {} --labels /nonexistent/x.png", fir_, quoted(folder_ / "m.png")));
  expect_one_clear_error(refused);
  EXPECT_FALSE(fs::exists(folder_ / "m.png"));
}

}  // namespace
}  // namespace espalier
