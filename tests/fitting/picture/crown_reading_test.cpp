// The crown envelope that is read off a picture: the numbers of crowns that were drawn.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include <espalier/core/error.h>
#include <espalier/environment/volume.h>
#include <espalier/fitting/picture/crown_reading.h>
#include <espalier/image/reading/read_target.h>

namespace espalier {
namespace {

/// How far out the profile from an apex to a rim is at height z.
double profile_x(double apex_x, double apex_z, double rim_x, double rim_z, double shape, double z) {
  const double up = (z - rim_z) / (apex_z - rim_z);
  return std::lerp(apex_x, rim_x, std::pow(1 - std::pow(up, shape), 1 / shape));
}

double side_x(const CrownReading& crown, double rim_x, double rim_z, double z) {
  return z > rim_z ? profile_x(crown.top_x, crown.top, rim_x, rim_z, crown.shape_above, z)
                   : profile_x(crown.base_x, crown.base, rim_x, rim_z, crown.shape_below, z);
}

/// Of a tree `size_px` high, on a trunk.
Mask drawn(const CrownReading& crown, int size_px) {
  Mask mask(2 * size_px, size_px + 20);
  for (int y = 10; y < size_px + 10; ++y)
    for (int x = 0; x < 2 * size_px; ++x) {
      const double z = (size_px + 10 - y - 0.5) / size_px, out = (x + 0.5 - size_px) / size_px;
      const bool is_crown = z > crown.base && z < crown.top &&
                            out < side_x(crown, crown.radius_right, crown.rim_right, z) &&
                            out > side_x(crown, -crown.radius_left, crown.rim_left, z);
      if (is_crown || (std::fabs(out) < 0.02 && z <= crown.base + 0.05)) mask.set(x, y);
    }
  return mask;
}

CrownReading read(const Mask& mask) { return read_crown(mask, read_picture(mask)); }

TEST(CrownReading, TheNumbersOfACrownThatIsDrawnAreRead) {
  const CrownReading shapes[] = {{.top_x = 0.05,
                                  .base = 0.25,
                                  .radius_right = 0.3,
                                  .radius_left = 0.45,
                                  .rim_right = 0.6,
                                  .rim_left = 0.5},
                                 {.base = 0.3,
                                  .radius_right = 0.35,
                                  .radius_left = 0.25,
                                  .rim_right = 0.45,
                                  .rim_left = 0.65,
                                  .shape_above = 1.3,
                                  .shape_below = 3}};
  for (const CrownReading& crown : shapes) {
    const CrownReading read_back = read(drawn(crown, 400));
    EXPECT_NEAR(read_back.top, 1, 0.01);
    EXPECT_NEAR(read_back.top_x, crown.top_x, 0.03);
    EXPECT_NEAR(read_back.base, crown.base, 0.05);  // where the outline is wider than a trunk
    EXPECT_NEAR(read_back.radius_right, crown.radius_right, 0.01);
    EXPECT_NEAR(read_back.radius_left, crown.radius_left, 0.01);
    EXPECT_NEAR(read_back.rim_right, crown.rim_right, 0.05);
    EXPECT_NEAR(read_back.rim_left, crown.rim_left, 0.05);
    EXPECT_NEAR(std::log(read_back.shape_above / crown.shape_above), 0, 0.2);
    EXPECT_NEAR(std::log(read_back.shape_below / crown.shape_below), 0, 0.35);
  }
}

TEST(CrownReading, OfThePicturesOfLeafyTreesItIsAVolume) {
  for (const char* name : {"fir", "oc_orange"}) {
    const std::filesystem::path file =
        std::filesystem::path(ESPALIER_SOURCE_DIR) / "targets" / (std::string(name) + ".png");
    const CrownReading crown = read(read_target(file, {.size_px = 128}).mask);
    const auto volume = parse_volume(crown_text(crown, 10));
    EXPECT_TRUE(volume->contains({0, 0, static_cast<float>(5 * (crown.top + crown.base))})) << name;
    EXPECT_FALSE(volume->contains({0, 0, static_cast<float>(10 * crown.top + 0.1)})) << name;
  }
}

TEST(CrownReading, AsAVolumeItReachesAsFarOnEachSide) {
  const CrownReading crown{.top_x = 0.05,
                           .base = 0.2,
                           .base_x = -0.02,
                           .radius_right = 0.3,
                           .radius_left = 0.5,
                           .rim_right = 0.6,
                           .rim_left = 0.4};
  const auto volume = parse_volume(crown_text(crown, 20));
  const CrownEnvelope envelope(crown_shape_of(crown, 20));
  for (const Volume* either :
       {static_cast<const Volume*>(&envelope), static_cast<const Volume*>(volume.get())}) {
    EXPECT_TRUE(either->contains({5.8f, 0, 12}));  // the right rim
    EXPECT_FALSE(either->contains({6.2f, 0, 12}));
    EXPECT_TRUE(either->contains({-9.8f, 0, 8}));  // the left rim
    EXPECT_FALSE(either->contains({-10.2f, 0, 8}));
    EXPECT_TRUE(either->contains({1, 0, 19.8f}));  // the top
    EXPECT_FALSE(either->contains({1, 0, 20.2f}));
    EXPECT_TRUE(either->contains({-0.4f, 0, 4.2f}));  // the base
    EXPECT_FALSE(either->contains({-0.4f, 0, 3.8f}));
    EXPECT_TRUE(either->contains({0, 7.6f, 10}));  // half way between the sides
    EXPECT_FALSE(either->contains({0, 8.4f, 10}));
  }
}

TEST(CrownReading, WhatIsNoCrownIsRefused) {
  Mask line(20, 20);
  line.set(3, 5);
  EXPECT_THROW(read(line), InputError);
}

}  // namespace
}  // namespace espalier
