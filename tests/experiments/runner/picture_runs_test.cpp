// Sheets of pictures: L-systems, what stands beside the tree, and seasons.
#include <gtest/gtest.h>

#include <fstream>

#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/csv.h>
#include <espalier/experiments/runner/run_experiment.h>
#include <espalier/image/pictures/decode.h>

#include "support/object_files.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

/// The directory of a sheet that was drawn; beside its file lies box.obj, from x = 2 to 4 m and 6 m high.
fs::path drawn(const std::string& text) {
  const fs::path folder = fresh_folder("sheet");
  write_box_obj(folder / "box.obj", {2, -1, 0}, {4, 1, 6});
  std::ofstream(folder / "sheet.toml") << "[pictures]\nsize = 64\nframe_m = 12\n" << text;
  run_experiment(read_experiment(folder / "sheet.toml"), folder / "out", {});
  return folder / "out";
}

DecodedPicture picture_of(const fs::path& out, int column) {
  return decode_picture(out / "runs" / fmt::format("row1-column{}", column) / "picture.png");
}

TEST(PictureRuns, AnObjectIsSeenWhereItStands) {
  const fs::path out = drawn(
      "species = 'palm'\ncolumns = [{label = 'alone'}, {label = 'beside', objects = ['mesh:box.obj']}]\n");
  const DecodedPicture alone = picture_of(out, 1), beside = picture_of(out, 2);
  // 64 px are 12 m: the box covers columns 43 to 53 and rows 29 to 60, as the foot is at row 60.8.
  int inside = 0, outside = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const bool differs = alone.at(x, y) != beside.at(x, y);
      if (x >= 43 && x < 53 && y >= 29 && y < 60) inside += differs;
      if (x < 10 || x > 55 || y > 61) outside += differs;
    }
  EXPECT_EQ(inside, 10 * 31);
  EXPECT_EQ(outside, 0);
}

TEST(PictureRuns, ObjectsOfTheSheetAreInEveryPicture) {
  const std::string columns = "species = 'palm'\ncolumns = [{label = 'a'}, {label = 'b'}]\n";
  const auto alone = picture_of(drawn(columns), 1).pixels;
  const fs::path out = drawn(columns + "objects = ['mesh:box.obj']\n");
  EXPECT_TRUE(picture_of(out, 1).pixels == picture_of(out, 2).pixels);
  EXPECT_TRUE(picture_of(out, 1).pixels != alone);
}

TEST(PictureRuns, LSystemsStandBesideSpecies) {
  const fs::path out = drawn(
      "species = 'palm'\ncolumns = [{label = 'species'}, {label = 'L-system', model = 'palm'}, "
      "{label = 'short', model = 'palm.lsys', set = {t_max = 100}}]\n");
  const CsvTable results = read_csv(out / "results.csv");
  ASSERT_EQ(results.rows.size(), 3u);
  for (std::size_t row = 0; row < 3; ++row) EXPECT_EQ(results.text(row, "status"), "done");
  EXPECT_NE(results.number(0, "leaves"), results.number(1, "leaves"));
  EXPECT_LT(results.number(2, "leaves"), results.number(1, "leaves")) << "the parameter is the L-system's";
}

TEST(PictureRuns, InWinterNoLeafIsLeft) {
  const fs::path out = drawn(
      "model = 'aspen'\ncolumns = [{label = 'summer'}, {label = 'autumn', season = 'autumn'}, "
      "{label = 'winter', season = 'winter'}]\n");
  const CsvTable results = read_csv(out / "results.csv");
  EXPECT_GT(results.number(0, "leaves"), 0);
  EXPECT_EQ(results.number(1, "leaves"), results.number(0, "leaves"));
  EXPECT_TRUE(picture_of(out, 1).pixels != picture_of(out, 2).pixels);
  EXPECT_EQ(results.number(2, "leaves"), 0);
  EXPECT_EQ(results.number(2, "stems"), results.number(0, "stems"));
}

TEST(PictureRuns, TheViewAndTheGroundChangeThePicture) {
  const std::string columns = "species = 'palm'\ncolumns = [{label = 'a'}]\n";
  const DecodedPicture front = picture_of(drawn(columns), 1);
  const DecodedPicture above = picture_of(drawn(columns + "view = '40,20'\n"), 1);
  EXPECT_TRUE(above.pixels != front.pixels);
  EXPECT_TRUE(picture_of(drawn(columns + "view = '40,20'\nground = true\n"), 1).pixels != above.pixels);
}

}  // namespace
}  // namespace espalier
