// Sizes, views and paths of pictures as they are written on the command line.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <espalier/app/options/view_options.h>
#include <espalier/core/error.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

TEST(PictureSize, OneNumberIsASquareAndTwoAreWidthAndHeight) {
  EXPECT_EQ(parse_size("64").width_px, 64);
  EXPECT_EQ(parse_size("64").height_px, 64);
  EXPECT_EQ(parse_size("64x32").width_px, 64);
  EXPECT_EQ(parse_size("64x32").height_px, 32);
}

TEST(PictureSize, RefusesWhatIsNoSize) {
  for (const char* text : {"", "0", "4097", "-1", "64x", "x64", "64x32x16", "6.5", "64 "})
    EXPECT_THROW(parse_size(text), InputError) << text;
}

TEST(ViewOptions, RefuseAnglesOutsideTheirRange) {
  ViewOptions options;
  EXPECT_NO_THROW(check_view(options));
  options.view = "30,91";
  EXPECT_THROW(check_view(options), InputError);
  options.view = "30,";
  EXPECT_THROW(check_view(options), InputError);
  options.view = "30,10";
  EXPECT_NO_THROW(check_view(options));
}

TEST(ViewOptions, AnglesAreFiniteNumbers) {
  EXPECT_TRUE(parse_angles("30,-10"));
  for (const char* text : {"nan", "nan,nan", "0,inf", "-inf,0", "1e300,0", "", ","})
    EXPECT_FALSE(parse_angles(text)) << text;
}

TEST(ViewOptions, TheCameraHasTheSizeAndHoldsThePlant) {
  Plant plant;
  ViewOptions options;
  options.size = "40x30";
  const Camera camera = camera_of(options, plant);
  EXPECT_EQ(camera.width_px, 40);
  EXPECT_EQ(camera.height_px, 30);
}

TEST(PicturePath, EndsAsToldAndLiesInAFolder) {
  const std::filesystem::path folder = fresh_folder("picture_path");
  EXPECT_NO_THROW(check_png_path((folder / "a.png").string()));
  EXPECT_THROW(check_png_path((folder / "a.jpg").string()), InputError);
  EXPECT_NO_THROW(check_picture_path((folder / "a.gif").string(), {".png", ".gif"}));
  EXPECT_THROW(check_png_path((folder / "nowhere/a.png").string()), InputError);
  std::filesystem::create_directory(folder / "b.png");
  EXPECT_THROW(check_png_path((folder / "b.png").string()), InputError);
}

}  // namespace
}  // namespace espalier
