// The volume of surfaces that overlap: their sum counts what lies in two of them twice, their union does not.
#include <gtest/gtest.h>

#include <espalier/plant/mesh_volume.h>

#include "support/hand_made_plants.h"
#include "support/mesh_fixtures.h"

namespace espalier {
namespace {

constexpr std::size_t kCrossings = 200'000;

TriangleMesh box_mesh(Vec3 lower, Vec3 upper) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.position_m.push_back(
        {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TriangleMesh joined_meshes(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.position_m.size());
  a.position_m.insert(a.position_m.end(), b.position_m.begin(), b.position_m.end());
  for (auto triangle : b.triangles) {
    for (std::uint32_t& vertex : triangle) vertex += first;
    a.triangles.push_back(triangle);
  }
  return a;
}

TEST(MeshVolume, OfOneClosedSurfaceIsWhatItEncloses) {
  const TriangleMesh box = box_mesh({0.1f, 0.2f, 0.3f}, {1.1f, 2.2f, 3.3f});
  ASSERT_NEAR(enclosed_volume_m3(box), 6, 1e-5);
  const MeshVolume volume = measure_volume(box, kCrossings);
  EXPECT_NEAR(volume.sum_m3, 6, 0.03);
  EXPECT_DOUBLE_EQ(volume.union_m3, volume.sum_m3);
}

TEST(MeshVolume, CountsTheOverlapOfTwoOnceInTheUnionAndTwiceInTheSum) {
  const MeshVolume volume = measure_volume(
      joined_meshes(box_mesh({0, 0, 0}, {2, 2, 2}), box_mesh({1, 1, 1}, {3, 3, 3})), kCrossings);
  EXPECT_NEAR(volume.sum_m3, 16, 0.08);
  EXPECT_NEAR(volume.union_m3, 15, 0.08);
}

TEST(MeshVolume, OfSurfacesInOneAnotherIsTheOuterOnes) {
  const MeshVolume volume = measure_volume(
      joined_meshes(box_mesh({0, 0, 0}, {2, 2, 2}), box_mesh({0.5f, 0.5f, 0.5f}, {1, 1, 1})), kCrossings);
  EXPECT_NEAR(volume.sum_m3, 8.125, 0.05);
  EXPECT_NEAR(volume.union_m3, 8, 0.05);
}

TEST(MeshVolume, OfAPlantsTubesSumsToWhatTheyEnclose) {
  const PlantMesh mesh = mesh_plant(small_plant(), {});
  const MeshVolume volume = measure_volume(mesh.bark, kCrossings);
  EXPECT_NEAR(volume.sum_m3, enclosed_volume_m3(mesh.bark), 0.005 * volume.sum_m3);
  EXPECT_LE(volume.union_m3, volume.sum_m3);
}

/// The diagonals of its upper and lower side lie on the middles of columns.
TEST(MeshVolume, CrossesAnEdgeOfTwoTrianglesOnce) {
  const MeshVolume volume = measure_volume(box_mesh({-0.5f, -0.5f, 0}, {0.5f, 0.5f, 1}), kCrossings);
  EXPECT_DOUBLE_EQ(volume.sum_m3, volume.union_m3);
}

TEST(MeshVolume, OfNothingIsNone) { EXPECT_EQ(measure_volume({}, kCrossings).union_m3, 0); }

}  // namespace
}  // namespace espalier
