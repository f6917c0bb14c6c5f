// Laws of volumes: boxes, balls, cylinders, meshes, and their command-line forms. Meshes are written by
// the tests as OBJ or STL text into the test's own directory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/environment/volume.h>

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct Face {
  int a, b, c;
};

struct Surface {
  std::vector<Vec3> vertices;
  std::vector<Face> faces;
};

/// The message of the InputError that parsing `text` throws; empty where it throws none.
std::string error_of(const std::string& text) {
  try {
    parse_volume(text);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

class MeshFiles : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    directory_ =
        fs::temp_directory_path() / (std::string("espalier_") + info->name() + std::to_string(getpid()));
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name) << text;
    return directory_ / name;
  }
  fs::path write_obj(const Surface& surface) const {
    std::string text;
    for (Vec3 v : surface.vertices) text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    for (Face f : surface.faces) text += fmt::format("f {} {} {}\n", f.a + 1, f.b + 1, f.c + 1);
    return write("mesh.obj", text);
  }

  fs::path directory_;
};

/// The box [-1, 1]³ · half + center, its normals outwards.
Surface cube(Vec3 center, float half) {
  Surface cube;
  for (int i = 0; i < 8; ++i)
    cube.vertices.push_back(center + Vec3{i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
  cube.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return cube;
}

void append(Surface& to, const Surface& more) {
  const int offset = static_cast<int>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (Face f : more.faces) to.faces.push_back({f.a + offset, f.b + offset, f.c + offset});
}

/// A torus around z with its tube's middle at `major`; closed, not convex, with a hole.
Surface torus(float major, float minor, int rings, int sides) {
  Surface torus;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      const double a = 2 * std::numbers::pi * i / rings, b = 2 * std::numbers::pi * j / sides;
      const double r = major + minor * std::cos(b);
      torus.vertices.push_back({float(r * std::cos(a)), float(r * std::sin(a)), float(minor * std::sin(b))});
    }
  const auto index = [&](int i, int j) { return (i % rings) * sides + j % sides; };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      torus.faces.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      torus.faces.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  return torus;
}

/// Signed distance to the ideal torus.
float torus_distance(Vec3 p, float major, float minor) {
  const float around = std::hypot(p.x, p.y) - major;
  return std::hypot(around, p.z) - minor;
}

/// The surface of the cube [-n, n]³ as 2n × 2n squares a side, each two triangles.
Surface lattice_cube(int n) {
  Surface cube;
  for (int axis = 0; axis < 3; ++axis)
    for (int u = -n; u < n; ++u)
      for (int v = -n; v < n; ++v)
        for (const int height : {-n, n}) {
          const int first = static_cast<int>(cube.vertices.size());
          for (int corner = 0; corner < 4; ++corner) {
            const float c[3] = {float(u + corner % 2), float(v + corner / 2), float(height)};
            cube.vertices.push_back({c[axis], c[(axis + 1) % 3], c[(axis + 2) % 3]});
          }
          const bool top = height > 0;
          cube.faces.push_back({first, first + (top ? 3 : 1), first + (top ? 1 : 3)});
          cube.faces.push_back({first, first + (top ? 2 : 3), first + (top ? 3 : 2)});
        }
  return cube;
}

/// Random points are in the torus (2, 0.7) exactly where its formula says, away from the surface.
void expect_torus(const Volume& volume) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> coordinate(-3, 3);
  for (int i = 0; i < 50'000; ++i) {
    const Vec3 p{coordinate(random), coordinate(random), coordinate(random)};
    const float distance = torus_distance(p, 2, 0.7f);
    if (std::fabs(distance) < 0.01f) continue;  // between the mesh and the ideal surface
    ASSERT_EQ(volume.contains(p), distance < 0) << p.x << ' ' << p.y << ' ' << p.z;
  }
}

/// The share of `count` random points of the cube [-half, half]³ that `volume` holds.
double filled_share(const Volume& volume, float half, int count = 200'000) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(-half, half);
  int inside = 0;
  for (int i = 0; i < count; ++i)
    inside += volume.contains({coordinate(random), coordinate(random), coordinate(random)});
  return double(inside) / count;
}

TEST(Volume, ShapesHoldTheVolumeOfTheirFormula) {
  const double frame = 8.0 * 2 * 2 * 2, pi = std::numbers::pi;
  EXPECT_NEAR(filled_share(*make_box({0.1f, -0.2f, 0.3f}, {1, 2, 3}), 2) * frame, 6, 0.2);
  EXPECT_NEAR(filled_share(*make_ball({0.1f, 0, 0}, 1.5f), 2) * frame, 4 / 3. * pi * 1.5 * 1.5 * 1.5, 0.3);
  EXPECT_NEAR(filled_share(*make_cylinder({0, 0.2f, -1}, 1.2f, 2.5f), 2) * frame, pi * 1.2 * 1.2 * 2.5, 0.3);
}

TEST(Volume, SurfacesBelongToTheInside) {
  EXPECT_TRUE(make_box({1, 2, 3}, {2, 2, 2})->contains({2, 3, 4}));
  EXPECT_TRUE(make_ball({1, 2, 3}, 2)->contains({1, 2, 5}));
  EXPECT_TRUE(make_cylinder({0, 0, 1}, 2, 3)->contains({2, 0, 1}));
  EXPECT_TRUE(make_cylinder({0, 0, 1}, 2, 3)->contains({0, 2, 4}));
}

TEST(Volume, CylinderStandsOnItsBase) {
  const auto cylinder = make_cylinder({0, 0, 1}, 2, 3);
  EXPECT_FALSE(cylinder->contains({0, 0, 0.99f}));
  EXPECT_FALSE(cylinder->contains({0, 0, 4.01f}));
  EXPECT_FALSE(cylinder->contains({1.5f, 1.5f, 2}));
}

TEST(Volume, TextAndMakersGiveTheSameVolume) {
  EXPECT_TRUE(rc::check([] {
    const auto coordinate = [] { return *rc::gen::inRange(-300, 300) / 100.0f; };
    const Vec3 p{coordinate(), coordinate(), coordinate()};
    RC_ASSERT(parse_volume("box:0.5,-1,0,2,3,4")->contains(p) ==
              make_box({0.5f, -1, 0}, {2, 3, 4})->contains(p));
    RC_ASSERT(parse_volume("ball:1e-1,0,0,2.5")->contains(p) == make_ball({0.1f, 0, 0}, 2.5f)->contains(p));
    RC_ASSERT(parse_volume("cylinder:0,0,-1,2,2")->contains(p) ==
              make_cylinder({0, 0, -1}, 2, 2)->contains(p));
  }));
}

TEST(Volume, NoTextWithoutAKnownKindIsAVolume) {
  EXPECT_THAT(error_of(""), HasSubstr("no colon"));
  EXPECT_THAT(error_of("box"), HasSubstr("no colon"));
  EXPECT_THAT(error_of("cone:0,0,0,1"), AllOf(HasSubstr("unknown kind 'cone'"), HasSubstr("cylinder:cx")));
}

TEST(Volume, NumbersMustBeAllThereAndFinite) {
  EXPECT_THAT(error_of("box:0,0,0,1,1"), HasSubstr("5 numbers, expected 6"));
  EXPECT_THAT(error_of("ball:0,0,0,1,1"), HasSubstr("5 numbers, expected 4"));
  EXPECT_THAT(error_of("cylinder:"), HasSubstr("'' is not a finite number"));
  EXPECT_THAT(error_of("ball:0,0,0,nan"), HasSubstr("'nan' is not a finite number"));
  EXPECT_THAT(error_of("ball:0,inf,0,1"), HasSubstr("'inf'"));
  EXPECT_THAT(error_of("ball:0,1e308,0,1"), HasSubstr("'1e308'"));
  EXPECT_THAT(error_of("ball:0,0,0,1m"), HasSubstr("'1m'"));
}

TEST(Volume, SizesMustBePositive) {
  EXPECT_THAT(error_of("box:0,0,0,1,0,1"), HasSubstr("size in y is 0, expected a positive number"));
  EXPECT_THAT(error_of("box:0,0,0,1,1,-0"), HasSubstr("size in z is -0"));
  EXPECT_THAT(error_of("ball:0,0,0,-1"), HasSubstr("radius is -1"));
  EXPECT_THAT(error_of("cylinder:0,0,0,1,0"), HasSubstr("height is 0"));
  EXPECT_THROW(make_box({0, NAN, 0}, {1, 1, 1}), InputError);
  EXPECT_THROW(make_box({0, 0, 0}, {1, NAN, 1}), InputError);
}

TEST_F(MeshFiles, CubeMeshIsTheBoxAwayFromItsSurface) {
  const auto mesh = make_mesh_volume(write_obj(cube({0.5f, 0, -1}, 1.5f)));
  const auto box = make_box({0.5f, 0, -1}, {3, 3, 3});
  EXPECT_TRUE(rc::check([&] {
    const auto coordinate = [] { return *rc::gen::inRange(-300, 300) / 100.0f + 0.001f; };
    const Vec3 p{coordinate(), coordinate(), coordinate()};
    RC_ASSERT(mesh->contains(p) == box->contains(p));
  }));
}

TEST_F(MeshFiles, TorusMeshHoldsWhatItsFormulaHolds) {
  expect_torus(*make_mesh_volume(write_obj(torus(2, 0.7f, 96, 48))));
}

TEST_F(MeshFiles, WindingDirectionsDoNotMatter) {
  Surface mixed = torus(2, 0.7f, 96, 48);
  std::mt19937 random(5);
  for (Face& f : mixed.faces)
    if (random() % 2) std::swap(f.b, f.c);
  expect_torus(*make_mesh_volume(write_obj(mixed)));
}

TEST_F(MeshFiles, RaysThroughEdgesAndVerticesCountOnce) {
  // Rays from lattice points along all axes meet the vertices of this surface, others its diagonals.
  const auto mesh = make_mesh_volume(write_obj(lattice_cube(2)));
  for (float x = -3; x <= 3; x += 0.25f)
    for (float y = -3; y <= 3; y += 0.25f)
      for (float z = -3; z <= 3; z += 0.25f) {
        const float reach = std::max({std::fabs(x), std::fabs(y), std::fabs(z)});
        if (reach == 2) continue;  // on the surface
        EXPECT_EQ(mesh->contains({x, y, z}), reach < 2) << x << ' ' << y << ' ' << z;
      }
}

TEST_F(MeshFiles, OverlappingPartsAreOneVolume) {
  Surface two = cube({0, 0, 0}, 1);
  append(two, cube({1, 0.5f, 0.25f}, 1));
  const auto mesh = make_mesh_volume(write_obj(two));
  EXPECT_TRUE(mesh->contains({0.6f, 0.3f, 0.2f}));
  EXPECT_TRUE(mesh->contains({-0.6f, -0.7f, 0.1f}));
  EXPECT_TRUE(mesh->contains({1.7f, 0.6f, 0.1f}));
  EXPECT_FALSE(mesh->contains({-0.6f, 1.2f, 0.1f}));
}

TEST_F(MeshFiles, CavitiesWithWallsFacingInwardsAreOutside) {
  Surface shell = cube({0, 0, 0}, 2), hole = cube({0, 0, 0}, 1);
  for (Face& f : hole.faces) std::swap(f.b, f.c);
  append(shell, hole);
  const auto mesh = make_mesh_volume(write_obj(shell));
  EXPECT_FALSE(mesh->contains({0.3f, 0.2f, 0.1f}));
  EXPECT_TRUE(mesh->contains({0.3f, 1.2f, 0.1f}));
}

TEST_F(MeshFiles, StlWhichSharesNoVerticesIsClosed) {
  const Surface surface = cube({0, 0, 0}, 1);
  std::string text = "solid cube\n";
  for (Face f : surface.faces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (int i : {f.a, f.b, f.c})
      text += fmt::format("vertex {} {} {}\n", surface.vertices[i].x, surface.vertices[i].y,
                          surface.vertices[i].z);
    text += "endloop\nendfacet\n";
  }
  const auto mesh = parse_volume("mesh:" + write("cube.stl", text + "endsolid cube\n").string());
  EXPECT_TRUE(mesh->contains({0.3f, 0.2f, 0.1f}));
  EXPECT_FALSE(mesh->contains({0.3f, 0.2f, 1.1f}));
}

TEST_F(MeshFiles, OpenMeshesAreRefusedWithTheNumberOfOpenEdges) {
  Surface open = cube({0, 0, 0}, 1);
  open.faces.pop_back();
  EXPECT_THAT(error_of("mesh:" + write_obj(open).string()), HasSubstr("3 of 18 edges are open"));
}

TEST_F(MeshFiles, MeshesThatEncloseNothingAreRefused) {
  const Surface flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_THAT(error_of("mesh:" + write_obj(flat).string()), HasSubstr("encloses no volume"));
  Surface twice = cube({0, 0, 0}, 1);
  for (Face f : cube({0, 0, 0}, 1).faces) twice.faces.push_back({f.a, f.c, f.b});
  EXPECT_THAT(error_of("mesh:" + write_obj(twice).string()), HasSubstr("encloses no volume"));
}

TEST_F(MeshFiles, FilesThatAreNoMeshesAreRefused) {
  EXPECT_THAT(error_of("mesh:" + (directory_ / "missing.obj").string()), HasSubstr("no such file"));
  EXPECT_THAT(error_of("mesh:" + directory_.string() + "/sub.obj"), HasSubstr("no such file"));
  fs::create_directory(directory_ / "folder.obj");
  EXPECT_THAT(error_of("mesh:" + (directory_ / "folder.obj").string()), HasSubstr("not a file"));
  EXPECT_THAT(error_of("mesh:" + write("empty.obj", "").string()), HasSubstr("not readable as a mesh"));
  EXPECT_THAT(error_of("mesh:" + write("words.ply", "these are words\n").string()),
              HasSubstr("not readable"));
  EXPECT_THAT(error_of("mesh:" + write("a.txt", "v 0 0 0\n").string()),
              HasSubstr("unknown extension '.txt'"));
  EXPECT_THAT(error_of("mesh:"), HasSubstr("unknown extension ''"));
}

TEST_F(MeshFiles, VerticesMustBeFinite) {
  const std::string faces = "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n";
  const fs::path path = write("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 nan\n" + faces);
  EXPECT_THAT(error_of("mesh:" + path.string()), AllOf(HasSubstr("mesh '"), Not(HasSubstr("\n"))));
}

}  // namespace
}  // namespace espalier
