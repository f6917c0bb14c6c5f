// Laws of export: what Assimp reads back is what was meshed, in every format; glTF is y up with the
// materials its viewers need; nothing is left behind where writing fails.
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <espalier/core/error.h>
#include <espalier/plant/export.h>
#include <espalier/plant/mesh_colors.h>

#include "support/mesh_fixtures.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Export : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    directory_ =
        fs::temp_directory_path() / ("espalier_" + std::string(info->name()) + std::to_string(getpid()));
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  const aiScene& write_and_read(const PlantMesh& mesh, const std::string& name) {
    write_mesh(mesh, directory_ / name);
    const aiScene* scene = importer_.ReadFile((directory_ / name).string(), aiProcess_ValidateDataStructure);
    if (!scene) throw std::runtime_error(importer_.GetErrorString());
    return *scene;
  }
  std::string error_of_writing(const std::string& name) {
    try {
      write_mesh(mesh_plant(small_plant(), {}), directory_ / name);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory_)) names.insert(entry.path().filename());
    return names;
  }
  std::string bytes(const std::string& name) const {
    std::ifstream file(directory_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  fs::path directory_;
  Assimp::Importer importer_;
};

std::size_t triangles_in(const aiScene& scene) {
  std::size_t count = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m)
    for (unsigned f = 0; f < scene.mMeshes[m]->mNumFaces; ++f)
      count += scene.mMeshes[m]->mFaces[f].mNumIndices == 3;
  return count;
}

/// Triangles of the meshes whose material has this name.
std::size_t triangles_of(const aiScene& scene, const std::string& material) {
  std::size_t count = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m)
    if (scene.mMaterials[scene.mMeshes[m]->mMaterialIndex]->GetName() == aiString(material))
      count += scene.mMeshes[m]->mNumFaces;
  return count;
}

/// The triangles of the scene without their vertices' sharing, mapped back to z up.
TriangleMesh soup(const aiScene& scene, bool y_up) {
  TriangleMesh out;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const auto first = static_cast<std::uint32_t>(out.position_m.size());
      for (unsigned i = 0; i < 3; ++i) {
        const aiVector3D v = mesh.mVertices[mesh.mFaces[f].mIndices[i]];
        out.position_m.push_back(y_up ? Vec3{v.x, -v.z, v.y} : Vec3{v.x, v.y, v.z});
      }
      out.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return out;
}

PlantMesh bark_only() {
  PlantMesh mesh = mesh_plant(small_plant(), {});
  mesh.leaves = mesh.blossoms = {};
  return mesh;
}

TEST_F(Export, EveryFormatKeepsEveryTriangle) {
  const PlantMesh mesh = mesh_plant(small_plant(), {});
  for (const char* name : {"a.glb", "a.obj", "a.ply", "a.stl"})
    EXPECT_EQ(triangles_in(write_and_read(mesh, name)), mesh.triangle_count()) << name;
}

TEST_F(Export, EveryFormatKeepsSurfacesClosedAndTheirVolume) {
  const PlantMesh mesh = bark_only();
  const double volume = enclosed_volume_m3(mesh.bark), area = area_m2(mesh.bark);
  for (const std::string name : {"a.glb", "a.obj", "a.ply", "a.stl"}) {
    const TriangleMesh read = soup(write_and_read(mesh, name), name == "a.glb" || name == "a.obj");
    EXPECT_EQ(unmatched_edges(read), 0u) << name;
    EXPECT_NEAR(enclosed_volume_m3(read), volume, 1e-4 * volume) << name;
    EXPECT_NEAR(area_m2(read), area, 1e-4 * area) << name;
  }
}

TEST_F(Export, GltfAndObjAreYUpAndTheOthersZUp) {
  Plant plant;
  add_straight_stem(plant, {0, 0, 0}, {0, 1, 4}, 0.1f, 0);
  const PlantMesh mesh = mesh_plant(plant, {});
  const auto has_vertex = [](const aiScene& scene, aiVector3D tip) {
    const aiMesh& m = *scene.mMeshes[0];
    return std::any_of(m.mVertices, m.mVertices + m.mNumVertices,
                       [&](const aiVector3D& v) { return (v - tip).Length() < 1e-5f; });
  };
  EXPECT_TRUE(has_vertex(write_and_read(mesh, "a.glb"), {0, 4, -1}));
  EXPECT_TRUE(has_vertex(write_and_read(mesh, "a.obj"), {0, 4, -1}));
  EXPECT_TRUE(has_vertex(write_and_read(mesh, "a.ply"), {0, 1, 4}));
  EXPECT_TRUE(has_vertex(write_and_read(mesh, "a.stl"), {0, 1, 4}));
}

TEST_F(Export, MaterialsAreSeparate) {
  const PlantMesh mesh = mesh_plant(small_plant(), {});
  for (const char* name : {"a.glb", "a.obj"}) {
    const aiScene& scene = write_and_read(mesh, name);
    EXPECT_EQ(triangles_of(scene, "bark"), mesh.bark.triangles.size()) << name;
    EXPECT_EQ(triangles_of(scene, "leaf"), mesh.leaves.triangles.size()) << name;
    EXPECT_EQ(triangles_of(scene, "blossom"), mesh.blossoms.triangles.size()) << name;
  }
}

TEST_F(Export, NormalsAndTextureCoordinatesSurvive) {
  const PlantMesh mesh = mesh_plant(small_plant(), {});
  for (const char* name : {"a.glb", "a.obj", "a.ply"}) {
    const aiScene& scene = write_and_read(mesh, name);
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
      const aiMesh& read = *scene.mMeshes[m];
      ASSERT_TRUE(read.HasNormals() && read.HasTextureCoords(0)) << name;
      for (unsigned i = 0; i < read.mNumVertices; ++i) {
        ASSERT_NEAR(read.mNormals[i].Length(), 1, 1e-4) << name;
        ASSERT_TRUE(std::isfinite(read.mTextureCoords[0][i].x + read.mTextureCoords[0][i].y)) << name;
      }
    }
  }
}

TEST_F(Export, LeavesAreDoubleSidedInGltfAndBarkIsNot) {
  const aiScene& scene = write_and_read(mesh_plant(small_plant(), {}), "a.glb");
  for (unsigned m = 0; m < scene.mNumMaterials; ++m) {
    const std::string name = scene.mMaterials[m]->GetName().C_Str();
    int two_sided = -1;
    scene.mMaterials[m]->Get(AI_MATKEY_TWOSIDED, two_sided);
    EXPECT_EQ(two_sided, name == "leaf" || name == "blossom") << name;
  }
}

TEST_F(Export, GltfChunksFillTheFile) {
  write_mesh(mesh_plant(small_plant(), {}), directory_ / "a.glb");
  const std::string glb = bytes("a.glb");
  const auto word = [&](std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, glb.data() + at, 4);
    return value;
  };
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(word(4), 2u);
  EXPECT_EQ(word(8), glb.size());
  const std::uint32_t json_size = word(12);
  EXPECT_EQ(glb.substr(16, 4), "JSON");
  EXPECT_EQ(word(20 + json_size) + json_size + 28, glb.size());
  EXPECT_EQ(glb.substr(24 + json_size, 3), "BIN");
}

TEST_F(Export, PartsTooLargeForOnePieceStayWhole) {
  Plant plant;
  for (int i = 0; i < 30'000; ++i) add_leaf(plant, {0.001f * float(i), 0, 1}, {0, 1, 0}, {1, 0, 0});
  add_straight_stem(plant, {0, 0, 0}, {0, 0, 4}, 0.1f, 0);
  const PlantMesh mesh = mesh_plant(plant, {});
  ASSERT_GT(mesh.leaves.position_m.size(), 1u << 18);
  const aiScene& scene = write_and_read(mesh, "a.glb");
  EXPECT_GT(scene.mNumMeshes, 2u);
  EXPECT_EQ(triangles_of(scene, "leaf"), mesh.leaves.triangles.size());
  EXPECT_NEAR(area_m2(soup(scene, true)), area_m2(mesh.leaves) + area_m2(mesh.bark),
              1e-3 * area_m2(mesh.leaves));
}

TEST_F(Export, ObjNamesTheMaterialFileBesideIt) {
  write_mesh(mesh_plant(small_plant(), {}), directory_ / "my tree.v2.obj");
  EXPECT_EQ(files(), (std::set<std::string>{"my_tree.v2.mtl", "my tree.v2.obj"}));
  EXPECT_THAT(bytes("my tree.v2.obj"), HasSubstr("mtllib my_tree.v2.mtl\n"));
}

/// The largest coordinate of each axis.
std::array<float, 3> highest_of(const aiScene& scene) {
  std::array<float, 3> highest{};
  for (unsigned m = 0; m < scene.mNumMeshes; ++m)
    for (unsigned i = 0; i < scene.mMeshes[m]->mNumVertices; ++i)
      for (unsigned axis = 0; axis < 3; ++axis)
        highest[axis] = std::max(highest[axis], scene.mMeshes[m]->mVertices[i][axis]);
  return highest;
}

TEST_F(Export, TheTrunkPointsAlongTheAxisThatIsUp) {
  const PlantMesh mesh = bark_only();
  const float top_m =
      std::max_element(mesh.bark.position_m.begin(), mesh.bark.position_m.end(), [](Vec3 a, Vec3 b) {
        return a.z < b.z;
      })->z;
  for (const char* name : {"a.glb", "a.obj", "a.ply", "a.stl"})
    for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
      if (std::string_view(name) == "a.glb" && up == UpAxis::z) continue;
      write_mesh(mesh, directory_ / name, {up});
      const aiScene* scene = importer_.ReadFile((directory_ / name).string(), 0);
      ASSERT_TRUE(scene) << importer_.GetErrorString();
      EXPECT_NEAR(highest_of(*scene)[up == UpAxis::y ? 1 : 2], top_m, 1e-4) << name;
    }
  EXPECT_THROW(write_mesh(mesh, directory_ / "b.glb", {UpAxis::z}), InputError);
  EXPECT_FALSE(fs::exists(directory_ / "b.glb"));
}

TEST_F(Export, HeadersSayUnitsAndAxes) {
  const PlantMesh mesh = bark_only();
  for (const char* name : {"a.obj", "a.ply", "a.stl"}) {
    write_mesh(mesh, directory_ / name);
    const char* axis = usual_up_axis(name) == UpAxis::y ? "y" : "z";
    EXPECT_THAT(bytes(name).substr(0, 200), HasSubstr(std::string("Espalier: metres, ") + axis + " is up"))
        << name;
  }
  EXPECT_EQ(usual_up_axis("a.obj"), UpAxis::y);
  EXPECT_EQ(usual_up_axis("a.stl"), UpAxis::z);
}

TEST_F(Export, SameMeshGivesTheSameBytes) {
  const PlantMesh mesh = mesh_plant(small_plant(), {});
  write_mesh(mesh, directory_ / "a.glb");
  const std::string first = bytes("a.glb");
  write_mesh(mesh, directory_ / "a.glb");
  EXPECT_EQ(bytes("a.glb"), first);
}

TEST_F(Export, ExtensionsMayBeUpperCase) {
  write_mesh(mesh_plant(small_plant(), {}), directory_ / "A.GLB");
  EXPECT_EQ(bytes("A.GLB").substr(0, 4), "glTF");
}

TEST_F(Export, UnknownExtensionsAreRefused) {
  EXPECT_THAT(error_of_writing("a.fbx"),
              HasSubstr("unknown extension '.fbx', expected .glb, .obj, .ply or .stl"));
  EXPECT_THAT(error_of_writing("a"), HasSubstr("unknown extension ''"));
  EXPECT_TRUE(files().empty());
}

TEST_F(Export, PathsThatCannotBeWrittenAreRefused) {
  EXPECT_THAT(error_of_writing("missing/a.glb"), HasSubstr("no folder"));
  fs::create_directory(directory_ / "folder.glb");
  EXPECT_THAT(error_of_writing("folder.glb"), HasSubstr("is a folder"));
  EXPECT_THROW(export_mesh(small_plant(), "/proc/a.glb", {}), InputError);
}

TEST_F(Export, EmptyPlantsAreRefused) {
  EXPECT_THROW(export_mesh(Plant{}, directory_ / "a.glb", {}), InputError);
  EXPECT_TRUE(files().empty());
}

/// A stem whose upper segment is red and one red leaf of three.
Plant colored_plant() {
  const PartColor red{255, 0, 0, true};
  Plant plant;
  add_winding_stem(plant, 3, 0.02f);
  plant.knots.color = {{}, red, {}};
  for (int i = 0; i < 3; ++i) add_leaf(plant, {static_cast<float>(i), 0, 2}, {0, 1, 0}, {1, 0, 0});
  plant.leaves.color = {{}, red, {}};
  return plant;
}

TEST_F(Export, MeshesThatNeedTooMuchMemoryAreRefused) {
  const PlantMesh mesh = mesh_plant(small_plant(), {});
  const std::size_t triangles = mesh.triangle_count();
  write_mesh(mesh, directory_ / "a.ply", {.most_triangles = triangles});
  EXPECT_THAT([&] { write_mesh(mesh, directory_ / "b.ply", {.most_triangles = triangles - 1}); },
              testing::ThrowsMessage<InputError>(HasSubstr("expected at most")));
  EXPECT_EQ(files(), (std::set<std::string>{"a.ply"}));
}

TEST_F(Export, ColorsAreMaterials) {
  const Plant plant = colored_plant();
  const PlantMesh mesh = mesh_plant(plant, {});
  ASSERT_EQ(mesh.bark.color.size(), mesh.bark.triangles.size());
  const std::size_t per_leaf = mesh.leaves.triangles.size() / 3;
  for (const char* name : {"colors.glb", "colors.obj"}) {
    SCOPED_TRACE(name);
    const aiScene& scene = write_and_read(mesh, name);
    EXPECT_EQ(triangles_in(scene), mesh.bark.triangles.size() + mesh.leaves.triangles.size());
    EXPECT_EQ(triangles_of(scene, "leaf"), 2 * per_leaf);
    EXPECT_EQ(triangles_of(scene, "leaf_ff0000"), per_leaf);
    EXPECT_GT(triangles_of(scene, "bark"), 0u);
    EXPECT_GT(triangles_of(scene, "bark_ff0000"), 0u);
    for (unsigned m = 0; m < scene.mNumMaterials; ++m) {
      if (scene.mMaterials[m]->GetName() != aiString("leaf_ff0000")) continue;
      aiColor3D colour;
      EXPECT_EQ(scene.mMaterials[m]->Get(AI_MATKEY_COLOR_DIFFUSE, colour), AI_SUCCESS);
      EXPECT_NEAR(colour.r, 1, 1e-3);
      EXPECT_NEAR(colour.g, 0, 1e-3);
    }
  }
}

TEST_F(Export, ManyColorsAreRounded) {
  Plant plant;
  for (int i = 0; i < 2000; ++i) {
    add_leaf(plant, {static_cast<float>(i), 0, 2}, {0, 1, 0}, {1, 0, 0});
    plant.leaves.color.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i / 8),
                                  static_cast<std::uint8_t>(7 * i), true});
  }
  const TriangleMesh leaves = mesh_plant(plant, {}).leaves;
  const auto parts = split_by_color(leaves);
  std::size_t triangles = 0;
  for (const auto& [color, part] : parts) triangles += part.triangles.size();
  EXPECT_LE(parts.size(), kMostColors);
  EXPECT_GT(parts.size(), kMostColors / 16);
  EXPECT_EQ(triangles, leaves.triangles.size());
}

}  // namespace
}  // namespace espalier
