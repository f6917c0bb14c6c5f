// Laws of silhouettes, for every renderer, on plants made by hand. Metres and pixels.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <espalier/image/masks/mask.h>
#include <espalier/plant/leaf_outlines.h>
#include <espalier/render/embree/embree_renderer.h>
#include <espalier/render/embree/embree_scene.h>
#include <espalier/render/scanlines/scanline_renderer.h>
#include <espalier/render/silhouette.h>

#include "support/hand_made_plants.h"

namespace espalier {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The frame of all laws: `size_px` square, 10 m wide, centred at (0, 0, 4).
Camera camera_at(int size_px, View view = {}) {
  Camera camera = frame_bounds({{-5, -5, -1}, {5, 5, 9}}, view, size_px, size_px, 1);
  if (view.projection == Projection::orthographic) camera.metres_per_px = 10.0f / static_cast<float>(size_px);
  return camera;
}

using MakeRenderer = std::unique_ptr<SilhouetteRenderer> (*)();

class Silhouette : public testing::TestWithParam<std::pair<const char*, MakeRenderer>> {
 protected:
  static std::unique_ptr<SilhouetteRenderer> make_renderer() { return GetParam().second(); }
  static Mask silhouette(const Plant& plant, const Camera& camera) {
    Mask mask;
    make_renderer()->draw(plant, camera, mask);
    return mask;
  }
};

INSTANTIATE_TEST_SUITE_P(Renderers, Silhouette,
                         testing::Values(std::pair{"embree", &make_embree_renderer},
                                         std::pair{"scanline", &make_scanline_renderer}),
                         [](const auto& test) { return test.param.first; });

double area_m2(const Mask& mask, const Camera& camera) {
  return static_cast<double>(area_px(mask)) * camera.metres_per_px * camera.metres_per_px;
}

int lowest_row(const Mask& mask) {
  for (int y = mask.height_px() - 1; y >= 0; --y)
    for (const std::uint64_t word : mask.row(y))
      if (word != 0) return y;
  return -1;
}

Plant moved(Plant plant, Vec3 by) {
  for (auto* points :
       {&plant.knots.point_m, &plant.knots.handle_in_m, &plant.knots.handle_out_m, &plant.leaves.position_m})
    for (Vec3& p : *points) p += by;
  return plant;
}

Plant scaled(Plant plant, float factor) {
  for (auto* points :
       {&plant.knots.point_m, &plant.knots.handle_in_m, &plant.knots.handle_out_m, &plant.leaves.position_m})
    for (Vec3& p : *points) p = p * factor;
  for (auto* sizes : {&plant.knots.radius_m, &plant.leaves.length_m, &plant.leaves.width_m})
    for (float& size : *sizes) size *= factor;
  return plant;
}

Vec3 turned(Vec3 p, float angle_deg) {
  const float angle = angle_deg * std::numbers::pi_v<float> / 180;
  return {p.x * std::cos(angle) - p.y * std::sin(angle), p.x * std::sin(angle) + p.y * std::cos(angle), p.z};
}

Plant turned(Plant plant, float angle_deg) {
  for (auto* vectors : {&plant.knots.point_m, &plant.knots.handle_in_m, &plant.knots.handle_out_m,
                        &plant.leaves.position_m, &plant.leaves.axis, &plant.leaves.side})
    for (Vec3& v : *vectors) v = turned(v, angle_deg);
  return plant;
}

TEST_P(Silhouette, ACylinderFromTheSideIsARectangle) {
  Plant plant;
  add_cylinder(plant, {0, 0, 0}, {0, 0, 6}, 0.5f);
  const Camera camera = camera_at(500);
  EXPECT_NEAR(area_m2(silhouette(plant, camera), camera), 6.0, 0.02 * 6);
}

TEST_P(Silhouette, ACylinderFromAboveIsADisc) {
  Plant plant;
  add_cylinder(plant, {0, 0, 0}, {0, 0, 6}, 2);
  View view;
  view.elevation_deg = 90;
  const Camera camera = camera_at(500, view);
  EXPECT_NEAR(area_m2(silhouette(plant, camera), camera), 4 * std::numbers::pi, 0.02 * 12.6);
}

TEST_P(Silhouette, AConeIsATriangle) {
  Plant plant;
  const Vec3 points[] = {{0, 0, 0}, {0, 0, 6}};
  const float radii[] = {2, 0};
  add_stem(plant, points, radii);
  const Camera camera = camera_at(500);
  EXPECT_NEAR(area_m2(silhouette(plant, camera), camera), 12, 0.02 * 12);
}

TEST_P(Silhouette, ATrunkStandsFlatOnItsBase) {
  Plant plant;
  add_cylinder(plant, {0, 0, 0}, {0, 0, 6}, 1.5f);
  const Camera camera = camera_at(500);
  const int base_row = static_cast<int>(project(camera, {0, 0, 0}).y_px);
  EXPECT_NEAR(lowest_row(silhouette(plant, camera)), base_row, 1);
}

TEST_P(Silhouette, ABentStemFollowsItsCurve) {
  Plant plant;
  add_cylinder(plant, {-4, 0, 0}, {4, 0, 0}, 0.1f);
  plant.knots.handle_out_m[0] = {-4, 0, 8};
  plant.knots.handle_in_m[1] = {4, 0, 8};
  const Camera camera = camera_at(500);
  const Mask mask = silhouette(plant, camera);
  const PicturePoint top = project(camera, {0, 0, 6});  // the middle of the curve is at 3/4 of its handles
  EXPECT_TRUE(mask.get(static_cast<int>(top.x_px), static_cast<int>(top.y_px)));
  const PicturePoint chord = project(camera, {0, 0, 0});
  EXPECT_FALSE(mask.get(static_cast<int>(chord.x_px), static_cast<int>(chord.y_px)));
}

/// Pixels of `mask` with a neighbour outside of it, and their neighbours: where an edge runs.
Mask edges_of(const Mask& mask) {
  Mask edges(mask.width_px(), mask.height_px());
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x) {
      int set = 0;
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, mask.height_px() - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, mask.width_px() - 1); ++i)
          set += mask.get(i, j);
      edges.set(x, y, set > 0 && set < 9);
    }
  return edges;
}

TEST(EmbreeScene, ConesAgreeWithTheSweptCurvesUpToEdgePixels) {
  const Plant plant = random_tree(200, 0, 3);
  Plant bent = plant;
  for (std::size_t k = 0; k < bent.knots.size(); ++k) bent.knots.handle_out_m[k] += {0.05f, 0, 0.05f};
  for (const Plant& tree : {plant, bent}) {
    const Camera camera = camera_at(400);
    EmbreeScene cones(SceneQuality::fast_build, StemSurface::cones);
    EmbreeScene curves(SceneQuality::fast_build, StemSurface::curves);
    Mask of_cones, of_curves;
    cones.build(tree, stem_tolerance_m(tree, camera));
    curves.build(tree, stem_tolerance_m(tree, camera));
    cones.trace(camera, of_cones);
    curves.trace(camera, of_curves);
    const Mask curve_edges = edges_of(of_curves), cone_edges = edges_of(of_cones);
    std::size_t differing = 0, off_edges = 0;
    for (int y = 0; y < 400; ++y)
      for (int x = 0; x < 400; ++x) {
        const bool differs = of_cones.get(x, y) != of_curves.get(x, y);
        differing += differs;
        off_edges += differs && !curve_edges.get(x, y) && !cone_edges.get(x, y);
      }
    EXPECT_GT(area_px(of_curves), 2000u);
    EXPECT_EQ(off_edges, 0u);
    EXPECT_LT(differing, area_px(curve_edges) / 50);
  }
}

TEST_P(Silhouette, AreaGrowsWithSquareOfScale) {
  const Plant plant = random_tree(100, 500, 1);
  const Camera camera = camera_at(800);
  const double small = area_m2(silhouette(scaled(plant, 0.4f), camera), camera);
  const double large = area_m2(silhouette(scaled(plant, 0.8f), camera), camera);
  EXPECT_NEAR(large / small, 4, 0.1);
}

TEST_P(Silhouette, OrthographicIsInvariantToMovingAlongTheView) {
  const Plant plant = random_tree(100, 500, 1);
  const Camera camera = camera_at(256);
  const Mask here = silhouette(plant, camera);
  for (const float metres : {-64.0f, -3.0f, 8.0f, 512.0f})
    EXPECT_LE(differing_px(silhouette(moved(plant, camera.forward * metres), camera), here), 3u) << metres;
}

TEST_P(Silhouette, TurningPlantAndCameraTogetherChangesNothing) {
  const Plant plant = random_tree(100, 500, 1);
  for (const float elevation_deg : {0.0f, 25.0f}) {
    View view;
    view.elevation_deg = elevation_deg;
    const Mask front = silhouette(plant, camera_at(256, view));
    view.azimuth_deg = 70;
    const Mask side = silhouette(turned(plant, 70), camera_at(256, view));
    EXPECT_LT(differing_px(front, side), area_px(front) / 50);
    EXPECT_GT(differing_px(front, silhouette(plant, camera_at(256, view))), area_px(front) / 5);
  }
}

TEST_P(Silhouette, PerspectiveFromFarAwayTendsToOrthographic) {
  const Plant plant = random_tree(100, 500, 1);
  const Vec3 base{0, 0, 0};
  View view;
  const Mask orthographic = silhouette(plant, frame_base(base, view, 0.05f, 256, 256, 240));
  view.projection = Projection::perspective;
  view.field_of_view_deg = 40;
  const std::size_t near_px =
      differing_px(silhouette(plant, frame_base(base, view, 0.05f, 256, 256, 240)), orthographic);
  view.field_of_view_deg = 1;
  const std::size_t far_px =
      differing_px(silhouette(plant, frame_base(base, view, 0.05f, 256, 256, 240)), orthographic);
  EXPECT_LT(far_px, area_px(orthographic) / 10);
  EXPECT_GT(near_px, area_px(orthographic) / 5);
}

bool is_in_triangle(const LeafOutline& outline, const std::array<std::uint32_t, 3>& t, float x, float y) {
  const auto side = [&](Vec3 a, Vec3 b) { return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x); };
  const Vec3 a = outline.vertices[t[0]], b = outline.vertices[t[1]], c = outline.vertices[t[2]];
  return side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0;
}

TEST_P(Silhouette, ALeafIsItsTriangles) {
  for (int shape = 1; shape <= 10; ++shape) {
    SCOPED_TRACE(shape);
    Plant plant;
    plant.leaf_shape = shape;
    add_leaf(plant, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 8, 8);
    const Camera camera = camera_at(400);
    const Mask mask = silhouette(plant, camera);
    Mask expected(400, 400);
    for (int j = 0; j < 400; ++j)
      for (int i = 0; i < 400; ++i) {
        const Ray ray = camera_ray(camera, static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f);
        for (const auto& triangle : leaf_outline(shape).triangles)
          if (is_in_triangle(leaf_outline(shape), triangle, ray.origin_m.x / 8, ray.origin_m.z / 8))
            expected.set(i, j);
      }
    EXPECT_GT(area_px(mask), 1000u);
    EXPECT_LE(differing_px(mask, expected), 60u);
  }
}

TEST_P(Silhouette, ALeafOnEdgeIsNotSeen) {
  Plant plant;
  add_leaf(plant, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 8, 8);
  EXPECT_EQ(area_px(silhouette(plant, camera_at(256))), 0u);
}

TEST_P(Silhouette, ALeafFromTheSideIsAsWideAsItsCosine) {
  Plant plant;
  plant.leaf_shape = 9;
  const float angle = std::numbers::pi_v<float> / 3;
  add_leaf(plant, {0, 0, 0}, {0, 0, 1}, {std::cos(angle), std::sin(angle), 0}, 8, 8);
  const Camera camera = camera_at(400);
  EXPECT_NEAR(area_m2(silhouette(plant, camera), camera), 64 * 0.5, 0.64);
}

TEST_P(Silhouette, ABlossomOpensAlongItsAxis) {
  for (int shape = 1; shape <= 3; ++shape) {
    Plant plant;
    plant.blossom_shape = shape;
    add_leaf(plant, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 6, 6, LeafKind::blossom);
    const Camera camera = camera_at(256);
    const Mask mask = silhouette(plant, camera);
    const PicturePoint stalk = project(camera, {0, 0, 0});
    EXPECT_NEAR(lowest_row(mask), static_cast<int>(stalk.y_px), 2) << shape;
    EXPECT_GT(area_m2(mask, camera), 36 / 8.0)
        << shape;  // an eighth of the square around a flower seen from the side
  }
}

TEST_P(Silhouette, AnEmptyPlantIsAnEmptyMaskOfTheCamerasSize) {
  for (const auto projection : {Projection::orthographic, Projection::perspective}) {
    View view;
    view.projection = projection;
    const Mask mask = silhouette({}, frame_bounds(bounds({}), view, 70, 30));
    EXPECT_EQ(mask.width_px(), 70);
    EXPECT_EQ(mask.height_px(), 30);
    EXPECT_EQ(area_px(mask), 0u);
  }
}

TEST_P(Silhouette, EverySizeFromOnePixelUpIsFilledByWhatCoversIt) {
  Plant plant;
  plant.leaf_shape = 9;
  add_leaf(plant, {0, 0, -50}, {0, 0, 1}, {1, 0, 0}, 100, 100);
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {8, 8}, {63, 65}, {64, 64}, {130, 1}}) {
    const Camera camera = frame_base({0, 0, 0}, {}, 0.01f, width, height, 0);
    EXPECT_EQ(area_px(silhouette(plant, camera)), static_cast<std::size_t>(width) * height)
        << width << "x" << height;
  }
}

TEST_P(Silhouette, DegenerateStemsAndLeavesAreLeftOut) {
  Plant plant;
  add_cylinder(plant, {0, 0, 0}, {0, 0, 6}, 0.5f);
  const Camera camera = camera_at(256);
  const Mask alone = silhouette(plant, camera);
  add_cylinder(plant, {1, 0, 1}, {1, 0, 1}, 0.5f);     // no length
  add_cylinder(plant, {1, 0, 1}, {3, 0, 1}, 0);        // no radius
  add_cylinder(plant, {kNan, 0, 1}, {3, 0, 1}, 0.5f);  // no number
  add_cylinder(plant, {1, 0, 1}, {3, 0, 1}, kNan);
  add_cylinder(plant, {1, 0, 1}, {1e30f, 0, 1}, 1);  // out of any frame
  const Vec3 points[] = {{0, 0, 1}};
  const float radii[] = {1};
  add_stem(plant, points, radii);  // a single knot
  add_stem(plant, std::span(points).first(0), std::span(radii).first(0));
  add_leaf(plant, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 0, 5);
  add_leaf(plant, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 5, 0);
  add_leaf(plant, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, kNan, 5);
  add_leaf(plant, {0, kNan, 0}, {0, 0, 1}, {1, 0, 0}, 5, 5);
  add_leaf(plant, {0, 0, 0}, {0, 0, 1}, {0, 0, 1}, 5, 5);  // side along the axis
  add_leaf(plant, {0, kNan, 0}, {0, 0, 1}, {1, 0, 0}, 5, 5, LeafKind::blossom);
  EXPECT_EQ(silhouette(plant, camera), alone);
}

TEST_P(Silhouette, AStemWithARepeatedPointStaysWhole) {
  Plant plant;
  const Vec3 points[] = {{0, 0, 0}, {0, 0, 3}, {0, 0, 3}, {0, 0, 6}};
  const float radii[] = {0.5f, 0.5f, 0.5f, 0.5f};
  add_stem(plant, points, radii);
  const Camera camera = camera_at(500);
  EXPECT_NEAR(area_m2(silhouette(plant, camera), camera), 6.0, 0.02 * 6);
}

TEST_P(Silhouette, AStemWhoseHandlesLieOnItsKnotsIsStraight) {
  Plant plant;
  add_cylinder(plant, {0, 0, 0}, {0, 0, 6}, 0.5f);
  const Mask straight = silhouette(plant, camera_at(256));
  plant.knots.handle_out_m = plant.knots.handle_in_m = plant.knots.point_m;
  EXPECT_EQ(silhouette(plant, camera_at(256)), straight);
}

TEST_P(Silhouette, AUsedRendererDrawsAsAFreshOne) {
  const auto renderer = make_renderer();
  Mask mask;
  for (const int stems : {100, 3, 300, 0, 50}) {
    const Plant plant = random_tree(stems, stems * 5, static_cast<Seed>(stems));
    renderer->draw(plant, camera_at(200 + stems), mask);
    EXPECT_EQ(mask, silhouette(plant, camera_at(200 + stems))) << stems;
  }
  renderer->draw({}, camera_at(64), mask);
  EXPECT_EQ(area_px(mask), 0u);
}

TEST(EmbreeScene, TheDrawnPlantMayVanish) {
  EmbreeScene scene;
  const Camera camera = camera_at(128);
  Mask with_plant, without_plant;
  {
    const Plant plant = random_tree(50, 300, 1);
    scene.build(plant, 0.01f);
    scene.trace(camera, with_plant);
  }
  scene.trace(camera, without_plant);
  EXPECT_EQ(with_plant, without_plant);
}

std::vector<Mask> draw_all(int threads, MakeRenderer make_renderer) {
  std::vector<Mask> masks(24);
#pragma omp parallel num_threads(threads)
  {
    const auto renderer = make_renderer();
#pragma omp for schedule(dynamic, 1)
    for (int i = 0; i < 24; ++i)
      renderer->draw(random_tree(60, 400, static_cast<Seed>(i)), camera_at(200),
                     masks[static_cast<std::size_t>(i)]);
  }
  return masks;
}

TEST_P(Silhouette, TwoThreadsDrawTheSameBitsAsOne) {
  EXPECT_EQ(draw_all(2, GetParam().second), draw_all(1, GetParam().second));
}

}  // namespace
}  // namespace espalier
