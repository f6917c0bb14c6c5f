// `espalier compare`: the measures of two pictures as text and JSON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include <espalier/image/measures/compare.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/image/reading/read_target.h>

#include "support/picture_files.h"
#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kTargets = ESPALIER_SOURCE_DIR "/targets/";

TEST(CompareCommand, APictureEqualsItself) {
  const ProgramRun run = run_espalier("compare '" + kTargets + "tr_fir.png' '" + kTargets + "tr_fir.png'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("as they are"));
  EXPECT_THAT(run.out, HasSubstr("\niou                 1.000000\n"));
  EXPECT_THAT(run.out, HasSubstr("\ntruncated_distance  0.000000\n"));
}

TEST(CompareCommand, JsonHoldsTheMeasuresOfTheMasks) {
  const std::string a = kTargets + "tr_birch.png", b = kTargets + "tr_fir.png";
  const ProgramRun run = run_espalier("compare --json '" + a + "' '" + b + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  const MaskMetrics metrics = compare_masks(read_mask(a).mask, read_mask(b).mask);
  EXPECT_EQ(json["framed"], false);
  EXPECT_EQ(json["width_px"], 512);
  for (std::size_t row = 0; row < kMetricCount; ++row)
    EXPECT_EQ(json[kMetrics[row].name], metrics.values[row]) << kMetrics[row].name;
}

TEST(CompareCommand, PicturesOfDifferentSizesAreFramed) {
  const std::string a = kTargets + "fir.png", b = kTargets + "tr_fir.png";
  const ProgramRun run = run_espalier("compare --json --size 128 '" + a + "' '" + b + "'");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["framed"], true);
  EXPECT_EQ(json["width_px"], 128);
  EXPECT_GT(json["iou"], 0.85);
}

TEST(CompareCommand, WritesAnOverlay) {
  const fs::path folder = fresh_folder("compare");
  const ProgramRun run = run_espalier("compare '" + kTargets + "tr_birch.png' '" + kTargets +
                                      "tr_fir.png' --overlay '" + (folder / "overlay.png").string() + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_GT(fs::file_size(folder / "overlay.png"), 1000u);
  fs::remove_all(folder);
}

class CompareCommandBadPicture : public testing::TestWithParam<test::BadPicture> {};

TEST_P(CompareCommandBadPicture, IsOneLineOnEitherSide) {
  const fs::path folder = fresh_folder("compare_bad");
  const fs::path path = folder / GetParam().file;
  GetParam().write(path);
  const ProgramRun as_target = run_espalier("compare '" + kTargets + "tr_fir.png' '" + path.string() + "'");
  expect_one_clear_error(as_target);
  EXPECT_THAT(as_target.err, HasSubstr(GetParam().message));
  expect_one_clear_error(run_espalier("compare '" + path.string() + "' '" + kTargets + "tr_fir.png'"));
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Pictures, CompareCommandBadPicture, testing::ValuesIn(test::bad_pictures()),
                         [](const auto& info) {
                           std::string name = info.param.file;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

TEST(CompareCommand, AMissingArgumentIsOneLine) {
  expect_one_clear_error(run_espalier("compare '" + kTargets + "tr_fir.png'"));
}

}  // namespace
}  // namespace espalier
