// Which file a run reads its picture from, and that it is the picture of the run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include <espalier/core/field_error.h>
#include <espalier/fitting/run/run_pictures.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

/// A record of two views, whose pictures are in a folder of their own; a run's directory is beside it.
struct RunPictures : testing::Test {
  RunPictures() {
    fs::create_directory(folder / "pictures");
    fs::create_directory(folder / "run");
    write_text(front, "front");
    write_text(side, "side!");
    record.views = {{front, {}}, {side, {.azimuth_deg = 90}}};
    note_contents(record);
  }

  fs::path folder = fresh_folder("run_pictures");
  fs::path front = folder / "pictures/a.png", side = folder / "pictures/b.JPG";
  FitRecord record;
};

TEST_F(RunPictures, AreKeptUnderNamesOfTheirOwn) {
  EXPECT_EQ(kept_picture_name(record.views[0], 0), "picture.png");
  EXPECT_EQ(kept_picture_name(record.views[1], 1), "picture_2.JPG");
  keep_pictures(record, folder / "run");
  fs::remove_all(folder / "pictures");
  find_pictures(record, folder / "run");
  EXPECT_EQ(record.views[0].file(), folder / "run/picture.png");
  EXPECT_EQ(record.views[1].file(), folder / "run/picture_2.JPG");
}

TEST_F(RunPictures, AreFoundWhereTheyWereWhereTheRunKeptNone) {
  find_pictures(record, folder / "run");
  EXPECT_EQ(record.views[1].file(), side);
}

TEST_F(RunPictures, OfTheSameLengthButOtherBytesAreOthers) {
  write_text(side, "edis!");  // the same letters
  EXPECT_THROW(find_pictures(record, folder / "run"), FieldError);
  FitRecord again = record;
  EXPECT_THROW(find_pictures(again, folder / "run", {front.string(), side.string()}), FieldError);
}

TEST_F(RunPictures, AreAsManyAsViews) {
  EXPECT_THROW(find_pictures(record, folder / "run", {front.string()}), FieldError);
}

}  // namespace
}  // namespace espalier
