// Laws of shaded pictures: what is covered, what is lit, the same bits every time.
#include "render/shaded.h"

#include <gtest/gtest.h>
#include <omp.h>

#include "hand_made_plants.h"
#include "render/silhouette.h"

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

}  // namespace
}  // namespace espalier
