// Laws of meshes: closed tubes with the volume and area of their formula, unit normals that look outwards,
// finite texture coordinates, fewer triangles at less detail, leaves that are their outlines.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include <espalier/plant/leaf_outlines.h>
#include <espalier/plant/mesh.h>
#include <espalier/plant/tube.h>

#include "support/mesh_fixtures.h"

namespace espalier {
namespace {

constexpr double kPi = std::numbers::pi;

TriangleMesh tube(const Polyline& line, int sides) {
  TriangleMesh mesh;
  append_tube(line, sides, mesh);
  return mesh;
}

Polyline flattened(const Plant& plant, float tolerance_m) {
  Polyline line;
  flatten_stem(plant, 0, tolerance_m, line);
  return line;
}

Polyline winding_line(float tip_radius_m) {
  Plant plant;
  add_winding_stem(plant, 6, tip_radius_m);
  return flattened(plant, 0.01f);
}

/// The smallest cosine between a vertex's normal and those of the triangles around it.
float worst_normal_agreement(const TriangleMesh& mesh) {
  float worst = 1;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.position_m[t[0]];
    const Vec3 face = normalized(cross(mesh.position_m[t[1]] - a, mesh.position_m[t[2]] - a));
    for (const std::uint32_t corner : t) worst = std::min(worst, dot(face, mesh.normal[corner]));
  }
  return worst;
}

void expect_sound(const TriangleMesh& mesh) {
  ASSERT_EQ(mesh.position_m.size(), mesh.normal.size());
  ASSERT_EQ(mesh.position_m.size(), mesh.texture.size());
  for (std::size_t i = 0; i < mesh.position_m.size(); ++i) {
    ASSERT_NEAR(length(mesh.normal[i]), 1, 1e-5) << i;
    ASSERT_TRUE(std::isfinite(mesh.texture[i].u) && std::isfinite(mesh.texture[i].v)) << i;
    ASSERT_TRUE(std::isfinite(length(mesh.position_m[i]))) << i;
  }
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t corner : t) ASSERT_LT(corner, mesh.position_m.size());
}

TEST(Tube, CylinderHasTheVolumeAndAreaOfItsPrism) {
  const int n = 12;
  const double r = 0.3, h = 2, base = n / 2.0 * std::sin(2 * kPi / n) * r * r;
  const TriangleMesh mesh = tube({{{1, 2, 3}, {1, 2, 5}}, {0.3f, 0.3f}}, n);
  EXPECT_NEAR(enclosed_volume_m3(mesh), base * h, 1e-5);
  EXPECT_NEAR(area_m2(mesh), 2 * base + n * 2 * r * std::sin(kPi / n) * h, 1e-5);
}

TEST(Tube, ManySidesComeCloseToTheRoundCylinderAndCone) {
  const float r = 0.3f, h = 2;
  const TriangleMesh cylinder = tube({{{0, 0, 0}, {0, h, 0}}, {r, r}}, 64);
  EXPECT_NEAR(enclosed_volume_m3(cylinder), kPi * r * r * h, 0.002 * kPi * r * r * h);
  EXPECT_NEAR(area_m2(cylinder), 2 * kPi * r * (h + r), 0.001 * 2 * kPi * r * (h + r));
  const TriangleMesh cone = tube({{{0, 0, 0}, {h, 0, 0}}, {r, 0}}, 64);
  EXPECT_NEAR(enclosed_volume_m3(cone), kPi * r * r * h / 3, 0.002 * kPi * r * r * h / 3);
  const double cone_area = kPi * r * (r + std::hypot(r, h));
  EXPECT_NEAR(area_m2(cone), cone_area, 0.001 * cone_area);
}

TEST(Tube, EveryEdgeJoinsTwoTriangles) {
  EXPECT_EQ(unmatched_edges(tube({{{0, 0, 0}, {0, 0, 1}}, {0.3f, 0.2f}}, 3)), 0u);
  EXPECT_EQ(unmatched_edges(tube(winding_line(0.01f), 7)), 0u);
  EXPECT_EQ(unmatched_edges(tube(winding_line(0), 8)), 0u);
}

TEST(Tube, RingsOfNoRadiusAreOnePointAndClose) {
  const TriangleMesh beads = tube({{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}}, {0, 0.2f, 0, 0.2f}}, 6);
  EXPECT_EQ(unmatched_edges(beads), 0u);
  EXPECT_EQ(beads.triangles.size(), 6u + 6 + 6 + 4);  // three cones and one cap
  expect_sound(beads);
}

TEST(Tube, NormalsLookOutwards) {
  EXPECT_GT(worst_normal_agreement(tube({{{0, 0, 0}, {0, 0, 2}}, {0.3f, 0.1f}}, 32)), 0.99f);
  EXPECT_GT(worst_normal_agreement(tube(winding_line(0.05f), 32)), 0.9f);
}

TEST(Tube, NormalsOfAConeLeanByItsSlope) {
  const TriangleMesh cone = tube({{{0, 0, 0}, {0, 0, 1}}, {1, 0}}, 16);
  for (std::size_t i = 0; i < 34; ++i) EXPECT_NEAR(cone.normal[i].z, std::sqrt(0.5), 1e-5) << i;
}

TEST(Tube, RingsDoNotTwistAlongAPlaneCurve) {
  // On a curve in the plane y = 0 the frame keeps its angle to the plane's normal.
  Polyline arc;
  for (int i = 0; i <= 20; ++i) {
    const float a = 0.1f * static_cast<float>(i);
    arc.point_m.push_back({std::sin(a), 0, 1 - std::cos(a)});
    arc.radius_m.push_back(0.05f);
  }
  const TriangleMesh mesh = tube(arc, 8);
  for (std::size_t ring = 0; ring < arc.size(); ++ring)
    EXPECT_NEAR((mesh.position_m[ring * 9].y), mesh.position_m[0].y, 1e-5) << ring;
}

TEST(Tube, TextureRunsOnceAroundAndByCircumferencesAlong) {
  const TriangleMesh mesh = tube({{{0, 0, 0}, {0, 0, 2}}, {0.3f, 0.1f}}, 6);
  EXPECT_EQ(mesh.texture[0].u, 0);
  EXPECT_EQ(mesh.texture[6].u, 1);
  EXPECT_EQ(mesh.position_m[0], mesh.position_m[6]);
  EXPECT_NEAR(mesh.texture[7].v, 2 / (2 * kPi * 0.3), 1e-5);
}

TEST(Tube, LinesOfOnePointHaveNone) { EXPECT_TRUE(tube({{{0, 0, 0}}, {0.3f}}, 6).triangles.empty()); }

TEST(Tube, SidesKeepFlatsWithinTheTolerance) {
  EXPECT_TRUE(rc::check([] {
    const float radius_m = static_cast<float>(*rc::gen::inRange(1, 1000)) / 1000;
    const float tolerance_m = static_cast<float>(*rc::gen::inRange(1, 1000)) / 10000;
    const int sides = tube_sides(radius_m, tolerance_m);
    RC_ASSERT(sides >= 3 && sides <= 64);
    if (sides > 3 && sides < 64) {
      RC_ASSERT(radius_m * (1 - std::cos(kPi / sides)) <= tolerance_m * 1.001);
      RC_ASSERT(radius_m * (1 - std::cos(kPi / (sides - 1))) >= tolerance_m * 0.999);
    }
  }));
}

TEST(Mesh, IsSoundInAllItsParts) {
  const PlantMesh mesh = mesh_plant(small_plant(), {0.5f});
  expect_sound(mesh.bark);
  expect_sound(mesh.leaves);
  expect_sound(mesh.blossoms);
}

TEST(Mesh, StemsStayClosedAtEveryDetail) {
  for (const float detail : {0.0f, 0.3f, 0.5f, 1.0f}) {
    const PlantMesh mesh = mesh_plant(small_plant(), {detail});
    EXPECT_EQ(unmatched_edges(mesh.bark), 0u) << detail;
    EXPECT_GT(enclosed_volume_m3(mesh.bark), 0) << detail;
  }
}

TEST(Mesh, LessDetailNeverHasMoreTriangles) {
  std::size_t last = 0;
  for (int step = 0; step <= 20; ++step) {
    const std::size_t count = mesh_plant(small_plant(), {static_cast<float>(step) / 20}).triangle_count();
    EXPECT_GE(count, last) << step;
    last = count;
  }
  EXPECT_GT(last, 4 * mesh_plant(small_plant(), {0}).triangle_count());
}

TEST(Mesh, LeavesAreTheirOutlinesScaledAndPlaced) {
  for (int shape = 1; shape <= 10; ++shape) {
    Plant plant;
    plant.leaf_shape = shape;
    add_leaf(plant, {1, 2, 3}, {0, 0, 1}, {1, 0, 0});
    const TriangleMesh leaves = mesh_plant(plant, {1}).leaves;
    const LeafOutline& outline = leaf_outline(shape);
    ASSERT_EQ(leaves.position_m.size(), outline.vertices.size());
    ASSERT_EQ(leaves.triangles.size(), outline.triangles.size());
    for (std::size_t i = 0; i < outline.vertices.size(); ++i) {
      const Vec3 expected{1 + 0.1f * outline.vertices[i].x, 2, 3 + 0.2f * outline.vertices[i].y};
      EXPECT_LT(length(leaves.position_m[i] - expected), 1e-5) << shape << ' ' << i;
      EXPECT_LT(length(leaves.normal[i] - Vec3{0, -1, 0}), 1e-5) << shape << ' ' << i;
    }
    EXPECT_GT(worst_normal_agreement(leaves), 0.999f) << shape;
  }
}

TEST(Mesh, LeavesOfLowDetailAreKitesOfTheSameLength) {
  Plant plant;
  plant.leaf_shape = 4;
  add_leaf(plant, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  const TriangleMesh kite = mesh_plant(plant, {0}).leaves;
  EXPECT_EQ(kite.triangles.size(), 2u);
  EXPECT_GT(worst_normal_agreement(kite), 0.999f);
  EXPECT_EQ(kite.position_m[0], (Vec3{0, 0, 0}));
  EXPECT_NEAR(kite.position_m[2].z, 0.2f, 1e-6);
}

TEST(Mesh, NormalsOfStretchedBlossomsStandOnTheStretchedSurface) {
  for (int shape = 1; shape <= 3; ++shape) {
    Plant plant;
    plant.blossom_shape = shape;
    add_leaf(plant, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, LeafKind::blossom);
    plant.leaves.length_m[0] = plant.leaves.width_m[0] = 1;
    const TriangleMesh unit = mesh_plant(plant, {1}).blossoms;
    plant.leaves.width_m[0] = 0.2f;
    const TriangleMesh narrow = mesh_plant(plant, {1}).blossoms;
    expect_sound(narrow);
    for (std::size_t i = 0; i < unit.normal.size(); ++i) {
      const Vec3 tangent = any_perpendicular(unit.normal[i]);
      const Vec3 stretched = normalized({0.2f * tangent.x, tangent.y, tangent.z});
      EXPECT_NEAR(dot(narrow.normal[i], stretched), 0, 1e-4) << shape << ' ' << i;
      EXPECT_GT(dot(narrow.normal[i], unit.normal[i]), 0) << shape << ' ' << i;
    }
  }
}

TEST(Mesh, LeafTexturesFillTheUnitSquare) {
  const TriangleMesh leaves = mesh_plant(small_plant(), {1}).leaves;
  float lowest = 1, highest = 0;
  for (const TextureCoordinate t : leaves.texture) {
    lowest = std::min({lowest, t.u, t.v});
    highest = std::max({highest, t.u, t.v});
  }
  EXPECT_EQ(lowest, 0);
  EXPECT_EQ(highest, 1);
}

}  // namespace
}  // namespace espalier
