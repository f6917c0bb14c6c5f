// Cubes come back from every format; damaged ones are one line, whatever Assimp makes of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/environment/meshes/mesh_triangles.h>
#include <espalier/environment/meshes/ply_head.h>

#include "support/mutations.h"
#include "support/small_meshes.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

using testing::HasSubstr;

constexpr std::size_t kMany = 1000;

std::vector<Vec3> triangles_of(const std::string& bytes, const std::string& format) {
  return read_mesh_triangles(bytes, format, "mesh 'a'", kMany);
}

/// The error of reading it; empty where it is read.
std::string fault_of(const std::string& bytes, const std::string& format) {
  try {
    triangles_of(bytes, format);
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("mesh 'a'"));
    return error.what();
  }
  return "";
}

/// Six times the volume of the tetrahedra between the triangles and the origin.
double sixfold_volume(const std::vector<Vec3>& soup) {
  double sum = 0;
  for (std::size_t i = 0; i < soup.size(); i += 3) {
    const Vec3 a = soup[i], b = soup[i + 1], c = soup[i + 2];
    sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  }
  return sum;
}

class MeshFormats : public testing::TestWithParam<test::SmallMesh> {};

TEST_P(MeshFormats, ACubeHasItsTwelveTriangles) {
  const std::vector<Vec3> soup = triangles_of(GetParam().bytes, GetParam().format);
  ASSERT_EQ(soup.size(), 36u);
  EXPECT_FLOAT_EQ(std::fabs(sixfold_volume(soup)), 48);
}

TEST_P(MeshFormats, CutOffAnywhereItIsReadOrOneLine) {
  const std::string& bytes = GetParam().bytes;
  int refused = 0;
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 24)
    refused += !fault_of(bytes.substr(0, size), GetParam().format).empty();
  EXPECT_GT(refused, 0);
}

TEST_P(MeshFormats, DamagedItIsReadOrOneLine) {
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < test::mutation_count(); ++i)
    refused += !fault_of(test::mutate(GetParam().bytes, random), GetParam().format).empty();
  EXPECT_GT(refused, 0);
}

INSTANTIATE_TEST_SUITE_P(All, MeshFormats, testing::ValuesIn(test::small_meshes()),
                         [](const auto& format) { return std::string(format.param.name); });

TEST(MeshTriangles, ClaimsAreNotBelieved) {
  EXPECT_THAT(fault_of("OFF\n100000000 1 0\n0 0 0\n", "off"), HasSubstr("not readable as a mesh"));
  const std::string late = "ply\nformat ascii 1.0\ncomment " + std::string(5000, 'c') +
                           "\nelement vertex 99999999\nproperty float x\nend_header\n1\n";
  EXPECT_THAT(fault_of(late, "ply"), HasSubstr("got 'element vertex 99999999' in a file of"));
  EXPECT_THAT(fault_of("ply\nformat ascii 1.0\nelement face", "ply"), HasSubstr("it was cut off"));
}

TEST(MeshTriangles, NestedWithoutEndTheyAreOneLine) {
  EXPECT_THAT(fault_of(R"({"asset":)" + std::string(200'000, '['), "gltf"),
              HasSubstr("not readable as a mesh"));
  std::string chain;
  for (int i = 1; i < 100'000; ++i) chain += R"({"children":[)" + std::to_string(i) + "]},";
  const std::string uri = "data:application/octet-stream;base64," + base64(test::gltf_numbers());
  EXPECT_THAT(fault_of(test::gltf(uri, chain + R"({"mesh":0})"), "gltf"),
              HasSubstr("not readable as a mesh"));
  std::string doubling;  // ten children each: 10¹² cubes
  for (int level = 1; level < 12; ++level) {
    std::string children;
    for (int k = 0; k < 10; ++k) children += (k ? "," : "") + std::to_string(level);
    doubling += R"({"children":[)" + children + "]},";
  }
  EXPECT_THAT(fault_of(test::gltf(uri, doubling + R"({"mesh":0})"), "gltf"),
              HasSubstr("not readable as a mesh"));
}

TEST(MeshTriangles, AreNotMoreThanAskedFor) {
  EXPECT_THROW(read_mesh_triangles(test::obj_cube(), "obj", "mesh 'a'", 11), InputError);
  EXPECT_EQ(read_mesh_triangles(test::obj_cube(), "obj", "mesh 'a'", 12).size(), 36u);
}

TEST(MeshTriangles, OfOtherFilesNoneIsOpened) {
  const auto folder = fresh_folder("meshes");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);  // to open it would wait
  const std::string pipe = (folder / "pipe").string();
  EXPECT_EQ(triangles_of("mtllib " + pipe + "\n" + test::obj_cube(), "obj").size(), 36u);
  EXPECT_THAT(fault_of(test::gltf(pipe), "gltf"), HasSubstr("not readable as a mesh"));
}

TEST(MeshTriangles, TheFormatIsTheCallersChoice) {
  EXPECT_THAT(fault_of(test::off_cube(), "stl"), HasSubstr("not readable as a mesh"));
  EXPECT_TRUE(triangles_of("solid a\nendsolid a\n", "obj").empty());
}

TEST(MeshTriangles, VerticesAreFinite) {
  std::string cube = test::obj_cube();
  cube.replace(cube.find("-1 -1 -1"), 8, "nan -1 -1");
  EXPECT_THAT(fault_of(cube, "obj"), HasSubstr("mesh 'a'"));
}

}  // namespace
}  // namespace espalier
