// `espalier target`: what it writes and says, and that bad input is one line, exit code 2, and no file.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include <espalier/app/commands/target_sheet.h>
#include <espalier/image/masks/mask_box.h>
#include <espalier/image/pictures/decode.h>
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
                                         "-o mask.png --speck -2", "-o mask.png --threshold 2",
                                         "-o mask.png --sheet sheet.jpg", "-o mask.png --keep-marks dogs",
                                         "-o mask.png --region 1,2,3", "-o mask.png --tree 9",
                                         "-o missing/mask.png", "-o .", "-o /dev/full", "-o /proc/mask.png",
                                         "-o mask.png --unknown"));

TEST_F(TargetCommand, ABadValueIsNamedByItsOption) {
  EXPECT_THAT(run_espalier("target " + fir_ + " -o /dev/null --keep-marks dogs").err,
              HasSubstr("--keep-marks: got 'dogs'"));
  EXPECT_THAT(run_espalier("target " + fir_ + " -o /dev/null --threshold 2").err,
              HasSubstr("--threshold: got 2"));
}

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

/// Two trees, the left one larger, and letters above.
Mask two_trees() {
  Mask mask(300, 200);
  const auto draw_box = [&](int left, int top, int right, int bottom) {
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) mask.set(x, y);
  };
  draw_box(20, 40, 120, 140), draw_box(65, 140, 75, 190);
  draw_box(180, 60, 260, 140), draw_box(216, 140, 224, 190);
  for (int letter = 0; letter < 5; ++letter) draw_box(140 + 10 * letter, 10, 146 + 10 * letter, 18);
  return mask;
}

TEST_F(TargetCommand, TakesTheLargestOneOrAllOfSeveralTrees) {
  write_mask_png(folder_ / "two.png", two_trees());
  const auto width_over_height = [&](const std::string& option) {
    const fs::path mask = folder_ / "mask.png";
    const ProgramRun run =
        run_espalier(fmt::format("target {} -o {} {}", quoted(folder_ / "two.png"), quoted(mask), option));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const MaskBox box = box_of(read_mask(mask).mask);
    return static_cast<double>(box.width()) / box.height();
  };
  EXPECT_NEAR(width_over_height(""), 100.0 / 150, 0.02);
  EXPECT_NEAR(width_over_height("--tree 2"), 80.0 / 130, 0.02);
  EXPECT_NEAR(width_over_height("--all-trees"), 240.0 / 150, 0.02);
}

TEST_F(TargetCommand, ASheetShowsThePictureItsTreeWhatWasLeftOutAndTheMask) {
  write_mask_png(folder_ / "two.png", two_trees());
  const ProgramRun run = run_espalier(fmt::format("target {} -o {} --size 100 --all-trees --sheet {}",
                                                  quoted(folder_ / "two.png"), quoted(folder_ / "mask.png"),
                                                  quoted(folder_ / "sheet.png")));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("left out: a caption of 5 pieces at 140,10"));
  const DecodedPicture sheet = decode_picture(folder_ / "sheet.png");
  EXPECT_EQ(sheet.height_px, 100);
  const auto red_at = [&](int x, int y) { return std::lround(sheet.at(x, y)[0] * 255); };
  const int step_px = sheet.width_px / 4 + 1;  // of panels and the gaps between them
  EXPECT_EQ(red_at(20, 25), 255);              // a crown, as in the picture
  EXPECT_EQ(red_at(step_px + 20, 25), kPaleTreeColor.r);
  EXPECT_EQ(red_at(step_px + 47, 4), kLeftOutColor.r);  // the first letter
  EXPECT_EQ(red_at(2 * step_px + 20, 50), 255);         // the mask
  EXPECT_EQ(red_at(2 * step_px + 50, 5), 0);
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
