// Objects of pictures: what is read, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <espalier/core/error.h>
#include <espalier/environment/scene_object.h>

#include "support/object_files.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string object_error(const std::string& text) {
  SceneObjects objects;
  try {
    add_object(text, objects);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SceneObject, SeveralMeshesAreOneScene) {
  const auto folder = fresh_folder("scene");
  write_box_obj(folder / "a.obj", {0, 0, 0}, {1, 1, 1});
  write_box_obj(folder / "b.obj", {5, 0, 0}, {6, 2, 3});
  SceneObjects objects;
  add_object("mesh:" + (folder / "a.obj").string(), objects);
  add_object("mesh:" + (folder / "b.obj").string(), objects);
  EXPECT_EQ(objects.vertices_m.size(), 16u);
  ASSERT_EQ(objects.triangles.size(), 24u);
  for (std::size_t i = 0; i < 24; ++i)
    for (const std::uint32_t vertex : objects.triangles[i])
      EXPECT_EQ(objects.vertices_m.at(vertex).x >= 5, i >= 12);
}

TEST(SceneObject, WhatIsNoClosedMeshIsRefused) {
  const auto folder = fresh_folder("scene_bad");
  write_box_obj(folder / "open.obj", {0, 0, 0}, {1, 1, 1}, false);
  for (const std::string text : {"ball:0,0,0,1", "house.obj", "", "mesh:none.obj", "mesh:house.txt"})
    EXPECT_THAT(object_error(text),
                AllOf(HasSubstr("got '" + text + "'"), HasSubstr(", expected mesh:FILE")));
  EXPECT_THAT(object_error("mesh:" + (folder / "open.obj").string()),
              AllOf(HasSubstr("3 of 18 edges are open"), HasSubstr("expected mesh:FILE, a closed mesh")));
}

}  // namespace
}  // namespace espalier
