// Laws of shaded pictures: what is covered, what is lit, the same bits every time.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include <espalier/render/embree/embree_renderer.h>
#include <espalier/render/shading/shaded.h>
#include <espalier/render/silhouette.h>

#include "support/hand_made_plants.h"

namespace espalier {
namespace {

Camera camera_of(const Plant& plant, int size_px, float elevation_deg = 0) {
  View view;
  view.elevation_deg = elevation_deg;
  return frame_bounds(bounds(plant), view, size_px, size_px);
}

int brightness(Rgb c) { return c.r + c.g + c.b; }

Plant screen(Vec3 normal_side) {
  Plant plant;
  plant.leaf_shape = 9;
  add_leaf(plant, {0, 0, 0}, {0, 0, 1}, normal_side, 2, 2);
  return plant;
}

TEST(Shaded, AnEmptyPlantIsBackground) {
  ShadedSettings settings;
  settings.background_top = settings.background_bottom = {1, 1, 1};
  const Picture picture = render_shaded({}, camera_of({}, 16), settings);
  for (const Rgb pixel : picture.pixels) EXPECT_EQ(pixel, (Rgb{255, 255, 255}));
}

TEST(Shaded, CoversTheSilhouetteAndNothingElse) {
  const Plant plant = random_tree(60, 400, 1);
  const Camera camera = camera_of(plant, 96);
  ShadedSettings settings;
  settings.background_top = settings.background_bottom = {1, 1, 1};
  settings.samples_per_px = 64;
  const Picture picture = render_shaded(plant, camera, settings);
  Mask mask;
  make_embree_renderer()->draw(plant, camera, mask);
  std::size_t missing = 0;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      const bool is_white = picture.at(x, y) == Rgb{255, 255, 255};
      missing += mask.get(x, y) && is_white;
    }
  EXPECT_LE(missing, 1u);  // specks that fall between the samples of a pixel
}

/// The picture of a cut-out on white: covers are shares of light, not of sRGB's numbers.
int on_white(std::uint8_t srgb, std::uint8_t cover) {
  const auto to_light = [](double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const auto to_srgb = [](double c) {
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  };
  const double share = cover / 255.0;
  return static_cast<int>(std::lround(255 * to_srgb(share * to_light(srgb / 255.0) + 1 - share)));
}

TEST(Shaded, ACutOutOnWhiteIsThePictureBeforeWhite) {
  const Plant plant = random_tree(60, 400, 1);
  const Camera camera = camera_of(plant, 48);
  ShadedSettings settings;
  settings.background_top = settings.background_bottom = {1, 1, 1};
  const Picture before_white = render_shaded(plant, camera, settings);
  const CutOut cut = render_cut_out(plant, camera, settings);
  std::size_t open = 0, covered = 0;
  for (std::size_t i = 0; i < cut.cover.size(); ++i) {
    open += cut.cover[i] == 0;
    covered += cut.cover[i] > 0;
    const Rgb a = before_white.pixels[i], b = cut.picture.pixels[i];
    EXPECT_NEAR(a.r, on_white(b.r, cut.cover[i]), 3) << i;
    EXPECT_NEAR(a.b, on_white(b.b, cut.cover[i]), 3) << i;
  }
  EXPECT_GT(open, 100u);
  EXPECT_GT(covered, 100u);
}

TEST(Shaded, WhatStandsBetweenSunAndLeafDarkensIt) {
  Plant plant = screen({1, 0, 0});
  const Camera camera = camera_of(plant, 32);
  ShadedSettings settings;
  settings.sun_azimuth_deg = -60;
  settings.sun_elevation_deg = 0;
  const Rgb lit = render_shaded(plant, camera, settings).at(16, 16);
  add_leaf(plant, {-8.66f, -5, -2}, {0, 0, 1}, {0.5f, -0.866f, 0}, 6, 6);  // 10 m towards the sun, facing it
  const Rgb dark = render_shaded(plant, camera, settings).at(16, 16);
  EXPECT_LT(4 * brightness(dark), 3 * brightness(lit));
}

TEST(Shaded, ALeafLetsLightThrough) {
  const Plant plant = screen({1, 0, 0});
  ShadedSettings settings;
  settings.sun_azimuth_deg = 180;  // behind the leaf
  settings.sun_elevation_deg = 10;
  const Rgb through = render_shaded(plant, camera_of(plant, 32), settings).at(16, 16);
  settings.leaf_through = {0, 0, 0};
  const Rgb opaque = render_shaded(plant, camera_of(plant, 32), settings).at(16, 16);
  EXPECT_GT(brightness(through), brightness(opaque) + 30);
}

TEST(Shaded, TheGroundIsSeenFromAboveOnly) {
  const Plant plant = random_tree(20, 100, 1);
  ShadedSettings without, with;
  without.samples_per_px = with.samples_per_px = 2;
  with.ground = true;
  const auto pixels_that_differ = [&](float elevation_deg) {
    const Camera camera = camera_of(plant, 48, elevation_deg);
    const Picture a = render_shaded(plant, camera, without), b = render_shaded(plant, camera, with);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) differing += a.pixels[i] != b.pixels[i];
    return differing;
  };
  EXPECT_EQ(pixels_that_differ(0), 0u);
  EXPECT_GT(pixels_that_differ(15), 100u);
}

TEST(Shaded, AnyNumberOfThreadsGivesTheSameBits) {
  const Plant plant = random_tree(40, 300, 2);
  const Camera camera = camera_of(plant, 64, 10);
  ShadedSettings settings;
  settings.samples_per_px = 4;
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Picture one = render_shaded(plant, camera, settings);
  omp_set_num_threads(3);
  const Picture three = render_shaded(plant, camera, settings);
  omp_set_num_threads(threads);
  EXPECT_EQ(one.pixels, three.pixels);
}

TEST(Shaded, SeveralSidesAreThoseOfEachAlone) {
  Plant plant = random_tree(40, 0, 2);
  for (Vec3& handle : plant.knots.handle_out_m) handle += {0.4f, 0, 0.3f};  // curves, of few cones from afar
  Camera near = camera_of(plant, 48);
  near.metres_per_px /= 8;  // finer cones
  const Camera cameras[] = {camera_of(plant, 48), camera_of(plant, 48, 30), near};
  const std::vector<Picture> together = render_shaded(plant, cameras);
  ASSERT_EQ(together.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(together[i].pixels, render_shaded(plant, cameras[i]).pixels) << i;
}

TEST(Shaded, LeavesOfOneShadeLookAlike) {
  Plant plant;
  plant.leaf_shape = 9;
  for (const float x : {-2.0f, 2.0f}) add_leaf(plant, {x, 0, 0}, {0, 0, 1}, {1, 0, 0}, 2, 2);
  const Camera camera = camera_of(plant, 32);
  const auto difference = [&](std::vector<std::uint32_t> shade) {
    plant.leaves.shade = std::move(shade);
    const Picture picture = render_shaded(plant, camera);
    const Rgb a = picture.at(5, 16), b = picture.at(26, 16);
    return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
  };
  EXPECT_LT(3 * difference({7, 7}), difference({}));
  EXPECT_LT(3 * difference({kPlainShade, kPlainShade}), difference({}));
  EXPECT_EQ(difference({0, 1}), difference({}));
}

TEST(Shaded, PartsHaveTheColorsThatTheModelGaveThem) {
  Plant leaf = screen({1, 0, 0});
  leaf.leaves.color = {{255, 0, 0, true}};
  Plant stem;
  add_cylinder(stem, {0, 0, 0}, {0, 0, 2}, 0.5f);
  stem.knots.color = {{0, 0, 255, true}, {}};
  const Rgb red = render_shaded(leaf, camera_of(leaf, 32)).at(16, 16);
  const Rgb blue = render_shaded(stem, camera_of(stem, 32)).at(16, 16);
  EXPECT_GT(red.r, 3 * (red.g + red.b));
  EXPECT_GT(blue.b, 3 * (blue.r + blue.g));
}

}  // namespace
}  // namespace espalier
