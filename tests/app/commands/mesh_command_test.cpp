// `espalier mesh` as a user runs it: files that hold the plant, options that change it, one line of error.
#include <assimp/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A tree of a trunk and a few boughs, small enough to mesh in no time.
const std::string kSmallTree =
    "quaking_aspen --set levels=2 --set branches[1]=5 --set g_scale=5 --set g_scale_v=0";

class MeshCommand : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name());
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  ProgramRun mesh(const std::string& arguments, const std::string& name) const {
    return run_espalier("mesh " + arguments + " -o '" + path(name) + "'");
  }
  /// The mesh that these arguments make.
  std::string bytes_of(const std::string& arguments) const {
    const ProgramRun run = mesh(arguments, "out.stl");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read_text_file(path("out.stl"));
  }
  void expect_refused(const std::string& arguments, const std::string& name,
                      const std::string& message) const {
    SCOPED_TRACE(arguments + " " + name);
    const ProgramRun run = mesh(arguments, name);
    expect_one_clear_error(run);
    EXPECT_THAT(run.err, HasSubstr(message));
    EXPECT_TRUE(fs::is_empty(folder_));
  }

  fs::path folder_;
};

/// The largest height of a vertex in a z-up mesh file, and the largest distance from the z axis.
struct Extent {
  float top_m = 0, reach_m = 0;
};

Extent extent_of(const std::string& file) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file, 0);
  EXPECT_TRUE(scene) << importer.GetErrorString();
  Extent extent;
  for (unsigned m = 0; scene && m < scene->mNumMeshes; ++m)
    for (unsigned i = 0; i < scene->mMeshes[m]->mNumVertices; ++i) {
      const aiVector3D v = scene->mMeshes[m]->mVertices[i];
      extent.top_m = std::max(extent.top_m, v.z);
      extent.reach_m = std::max(extent.reach_m, std::hypot(v.x, v.y));
    }
  return extent;
}

/// The numbers behind "Kd" of a material of an mtl file.
std::string diffuse_of(const std::string& mtl, const std::string& material) {
  const auto begin = mtl.find("newmtl " + material), color = mtl.find("Kd ", begin);
  return mtl.substr(color, mtl.find('\n', color) - color);
}

TEST_F(MeshCommand, MaterialsHaveTheColoursOfTheSpeciesAndSeason) {
  const std::string small = " --set levels=2 --set branches[1]=5";
  ASSERT_EQ(mesh("silver_birch" + small, "birch.obj").exit_code, 0);
  ASSERT_EQ(mesh("european_larch" + small, "larch.obj").exit_code, 0);
  ASSERT_EQ(mesh("european_larch --season autumn" + small, "autumn.obj").exit_code, 0);
  EXPECT_EQ(
      mesh("european_larch --season winter" + small, "a.obj").out.find(" 0 of leaves") != std::string::npos,
      true);
  const std::string birch = read_text_file(path("birch.mtl")), larch = read_text_file(path("larch.mtl"));
  EXPECT_THAT(diffuse_of(birch, "bark"), testing::StartsWith("Kd 0.8"));
  EXPECT_NE(diffuse_of(birch, "bark"), diffuse_of(larch, "bark"));
  EXPECT_EQ(diffuse_of(larch, "bark"), diffuse_of(read_text_file(path("autumn.mtl")), "bark"));
  EXPECT_NE(diffuse_of(larch, "leaf"), diffuse_of(read_text_file(path("autumn.mtl")), "leaf"));
}

TEST_F(MeshCommand, SaysAxesAndVolumes) {
  EXPECT_THAT(mesh(kSmallTree, "a.obj").out, HasSubstr("metres, y is up"));
  EXPECT_THAT(mesh(kSmallTree + " --up z", "a.obj").out, HasSubstr("metres, z is up"));
  EXPECT_THAT(mesh(kSmallTree + " --volume", "a.stl").out, HasSubstr("which overlap at joints, is "));
  const auto json = nlohmann::json::parse(mesh(kSmallTree + " --volume --json", "a.ply").out);
  EXPECT_EQ(json["up"], "z");
  EXPECT_GT(json["wood_m3"]["union"], 0);
  EXPECT_LT(json["wood_m3"]["union"], json["wood_m3"]["sum"]);
}

TEST_F(MeshCommand, RefusesAxesAndSeasonsThatAreNone) {
  expect_refused(kSmallTree + " --up x", "a.obj", "--up: got 'x', expected y or z");
  expect_refused(kSmallTree + " --up z", "a.glb", "expected y, which glTF demands");
  expect_refused(kSmallTree + " --season fall", "a.glb", "--season: got 'fall', expected one of: summer");
}

TEST_F(MeshCommand, WritesEveryFormat) {
  for (const char* name : {"a.glb", "a.obj", "a.ply", "a.stl"}) {
    const ProgramRun run = mesh(kSmallTree, name);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("triangles of bark"));
    EXPECT_GT(fs::file_size(path(name)), 1000u) << name;
  }
  EXPECT_TRUE(fs::exists(path("a.mtl")));
}

TEST_F(MeshCommand, SameSeedGivesTheSameMeshAndAnotherAnother) {
  const std::string first = bytes_of(kSmallTree + " --seed 3");
  EXPECT_EQ(bytes_of(kSmallTree + " --seed 3"), first);
  EXPECT_NE(bytes_of(kSmallTree + " --seed 4"), first);
}

TEST_F(MeshCommand, MoreDetailMakesLargerMeshes) {
  const std::string low = bytes_of(kSmallTree + " --detail low"),
                    high = bytes_of(kSmallTree + " --detail high");
  EXPECT_LT(low.size(), high.size());
  EXPECT_EQ(bytes_of(kSmallTree + " --detail 0"), low);
  EXPECT_EQ(bytes_of(kSmallTree + " --detail 1"), high);
  EXPECT_EQ(bytes_of(kSmallTree), bytes_of(kSmallTree + " --detail medium"));
}

TEST_F(MeshCommand, SetChangesTheTree) {
  ASSERT_EQ(mesh(kSmallTree, "small.stl").exit_code, 0);
  ASSERT_EQ(mesh(kSmallTree + " --set g_scale=10", "tall.stl").exit_code, 0);
  EXPECT_GT(extent_of(path("tall.stl")).top_m, 1.5f * extent_of(path("small.stl")).top_m);
}

TEST_F(MeshCommand, SetTakesCurves) {
  const std::string bare = kSmallTree + " --set branches[1]=30 --set leaf_blos_num=0";
  ASSERT_EQ(mesh(bare, "plain.stl").exit_code, 0);
  ASSERT_EQ(mesh(bare + " --set 'length_along[1]=[0.1, 0.1, 0.1, 0.2]'", "narrow.stl").exit_code, 0);
  EXPECT_LT(extent_of(path("narrow.stl")).reach_m, 0.4f * extent_of(path("plain.stl")).reach_m);
}

TEST_F(MeshCommand, BadCurvesAreRefused) {
  for (const auto& [curve, message] :
       {std::pair{"length_along[1]=1,2", "key 'length_along[1]': got 2 numbers, expected 1, 4, 5 or 7"},
        {"length_along[1]=1,x,1,1", "got '1,x,1,1', expected 1, 4, 5 or 7 numbers"},
        {"radius_along[0]=1,-1,1,1", "key 'radius_along[0]': got -1, expected a number 0..10"},
        {"density_along[1]=0", "got a density of 0 everywhere"},
        {"length_along[5]=1", "closest is 'length_along[1]"}})
    expect_refused(kSmallTree + " --set '" + curve + "'", "a.glb", message);
}

TEST_F(MeshCommand, PruningKeepsBranchesInsideTheVolume) {
  const std::string bare = kSmallTree + " --set branches[1]=30 --set leaf_blos_num=0";
  ASSERT_EQ(mesh(bare, "free.stl").exit_code, 0);
  ASSERT_EQ(mesh(bare + " --prune-to cylinder:0,0,0,0.6,20", "pruned.stl").exit_code, 0);
  EXPECT_GT(extent_of(path("free.stl")).reach_m, 1);
  EXPECT_LT(extent_of(path("pruned.stl")).reach_m, 0.8f);
}

TEST_F(MeshCommand, OutputsThatCannotBeAreRefused) {
  expect_refused(kSmallTree, "a.fbx", "unknown extension '.fbx'");
  expect_refused(kSmallTree, "missing/a.glb", "no folder");
  expect_one_clear_error(run_espalier("mesh " + kSmallTree + " -o /proc/a.glb"));
  expect_one_clear_error(run_espalier("mesh " + kSmallTree));
}

TEST_F(MeshCommand, AFullDiskLeavesNothing) {
  const ProgramRun run = run_shell("trap '' XFSZ; ulimit -f 1; '" ESPALIER_PROGRAM "' mesh " + kSmallTree +
                                   " -o '" + path("a.glb") + "'");
  expect_one_clear_error(run);
  EXPECT_THAT(run.err, HasSubstr("cannot be written"));
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(MeshCommand, BadVolumesAreRefused) {
  for (const auto& [volume, message] : {std::pair{"box:0,0,0,0,1,1", "size in x is 0"},
                                        {"box:0,0,0,nan,1,1", "'nan' is not a finite number"},
                                        {"cube:1", "unknown kind 'cube'"},
                                        {"mesh:none.obj", "no such file"}})
    expect_refused(kSmallTree + " --prune-to " + volume, "a.glb", message);
}

TEST_F(MeshCommand, OpenMeshVolumesAreRefused) {
  const fs::path open = fresh_folder("open") / "open.obj";
  std::ofstream(open) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n";
  expect_refused(kSmallTree + " --prune-to 'mesh:" + open.string() + "'", "a.glb", "3 of 6 edges are open");
  fs::remove_all(open.parent_path());
}

TEST_F(MeshCommand, BadDetailsSeedsAndParametersAreRefused) {
  expect_refused(kSmallTree + " --detail 1.5", "a.glb", "expected low, medium, high or a number from 0 to 1");
  expect_refused(kSmallTree + " --detail nan", "a.glb", "--detail nan");
  expect_refused(kSmallTree + " --seed -1", "a.glb", "expected a whole number");
  expect_refused(kSmallTree + " --set g_scale", "a.glb", "expected name=value");
  expect_refused(kSmallTree + " --set g_scale=", "a.glb", "got '' for g_scale");
  expect_refused(kSmallTree + " --set leaf_shape=0x3", "a.glb", "got '0x3' for leaf_shape");
  expect_refused(kSmallTree + " --set g_scale=nan", "a.glb", "g_scale");
  expect_refused(kSmallTree + " --set levels=9", "a.glb", "levels");
  expect_refused(kSmallTree + " --set g_skale=3", "a.glb", "g_skale");
  expect_refused("no_such_tree", "a.glb", "no_such_tree");
}

TEST_F(MeshCommand, PlantsBeyondTheBudgetAreRefusedBeforeTheyGrow) {
  expect_refused("quaking_aspen --set branches[1]=1000 --set branches[2]=1000 --set branches[3]=1000",
                 "a.glb", "times as many stems or leaves as allowed");
}

}  // namespace
}  // namespace espalier
