#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <espalier/core/error.h>
#include <espalier/image/separation/hints.h>

namespace espalier {
namespace {

using testing::AllOf;
using testing::HasSubstr;

template <typename Parse>
std::string refusal(Parse parse, const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Hints, AColorIsTheSameInEachNotation) {
  const ColorValue hex = parse_hinted_color("1A2b3c"), numbers = parse_hinted_color("26,43,60");
  EXPECT_EQ(hex, numbers);
  EXPECT_EQ(parse_hinted_color("#1A2b3c"), numbers);
  EXPECT_FLOAT_EQ(hex[0], 26.0f / 255);
  EXPECT_FLOAT_EQ(hex[2], 60.0f / 255);
}

TEST(Hints, WhatIsNoColorIsRefusedWithWhatIsOne) {
  for (const char* text : {"", "#12345", "#1234567", "12345g", "1,2", "1,2,3,4", "1,2,256", "-1,2,3", "red"})
    EXPECT_THAT(refusal(parse_hinted_color, text), AllOf(HasSubstr("got '"), HasSubstr("expected"))) << text;
}

TEST(Hints, ARegionAndPlacesAreReadInTheirOrder) {
  const PixelBox region = parse_region("1,2,30,40");
  EXPECT_EQ(region.left, 1);
  EXPECT_EQ(region.top, 2);
  EXPECT_EQ(region.width, 30);
  EXPECT_EQ(region.height, 40);
  const std::vector<PixelPlace> places = parse_places("5,6;7,8");
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].x, 5);
  EXPECT_EQ(places[1].y, 8);
}

TEST(Hints, WhatIsNoRegionOrPlaceIsRefused) {
  for (const char* text : {"1,2,3", "1,2,3,4,5", "1,2,0,4", "1,2,3,-4", "a,b,c,d", "1.5,2,3,4"})
    EXPECT_NE(refusal(parse_region, text), "") << text;
  for (const char* text : {"1", "1,2,3", ";1,2", "x,y"}) EXPECT_NE(refusal(parse_places, text), "") << text;
}

DecodedPicture picture_of(int width_px, int height_px) {
  DecodedPicture picture;
  picture.width_px = picture.source_width_px = width_px;
  picture.height_px = picture.source_height_px = height_px;
  return picture;
}

TEST(Hints, PlacesFollowAPictureThatWasMadeSmaller) {
  DecodedPicture picture = picture_of(100, 50);
  picture.source_width_px = 400;
  picture.source_height_px = 200;
  const SeparationOptions fitted =
      fitted_to({.region = PixelBox{40, 20, 200, 100}, .tree_seeds = {{80, 60}}}, picture, "a.png");
  EXPECT_EQ(fitted.region->left, 10);
  EXPECT_EQ(fitted.region->width, 50);
  EXPECT_EQ(fitted.tree_seeds[0].x, 20);
  EXPECT_EQ(fitted.tree_seeds[0].y, 15);
}

TEST(Hints, PlacesOutsideAreRefused) {
  const DecodedPicture picture = picture_of(100, 50);
  const auto fit = [&](const SeparationOptions& options) { fitted_to(options, picture, "a.png"); };
  EXPECT_NO_THROW(fit({.tree_seeds = {{99, 49}}}));
  EXPECT_THROW(fit({.tree_seeds = {{100, 49}}}), InputError);
  EXPECT_THROW(fit({.ground_seeds = {{99, 50}}}), InputError);
  EXPECT_THROW(fit({.ground_seeds = {{-1, 5}}}), InputError);
  EXPECT_THROW(fit({.region = PixelBox{50, 0, 51, 50}}), InputError);
  EXPECT_THROW(fit({.region = PixelBox{50, 0, 50, 51}}), InputError);
  EXPECT_THROW(fit({.region = PixelBox{50, 0, 2147483647, 50}}), InputError);
  EXPECT_THROW(fit({.region = PixelBox{0, 0, 50, 50}, .tree_seeds = {{60, 10}}}), InputError);
}

}  // namespace
}  // namespace espalier
