// Laws of surfaces: patches, meshes, outlines by name, frames of axes; and of colours.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/bundled.h>
#include <espalier/lsystem/files/grammar_file.h>
#include <espalier/lsystem/surfaces/patches.h>
#include <espalier/lsystem/surfaces/surfaces.h>
#include <espalier/plant/leaf_outlines.h>

#include "support/strings.h"

namespace espalier::lsystem {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

Plant plant_of(const Grammar& grammar, int steps = 0) {
  Derivation derivation(grammar);
  derivation.start(1);
  derivation.run(steps);
  Plant plant;
  build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant);
  return plant;
}
Plant plant_of(const std::string& text, int steps = 0) {
  return plant_of(parse_grammar(text, "test.lsys"), steps);
}

/// The area of triangles that are drawn as leaves of the triangular outline.
double area_of(const Plant& plant) {
  double area = 0;
  for (std::size_t i = 0; i < plant.leaves.size(); ++i)
    area += 0.5 * length(cross(plant.leaves.side[i] * plant.leaves.width_m[i],
                               plant.leaves.axis[i] * plant.leaves.length_m[i]));
  return area;
}

double area_of(const std::vector<Triangle>& triangles) {
  double area = 0;
  for (const auto& [a, b, c] : triangles) area += 0.5 * length(cross(b - a, c - a));
  return area;
}

template <typename Work>
std::string message_of(Work work) {
  try {
    work();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "no error";
}

class SurfaceFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("espalier_surfaces_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  Grammar grammar_with(const std::string& file) const {
    return read_grammar(
        write("test.lsys", "unit: 2\nsurface own = \"" + file + "\"\naxiom: F(1)~(\"own\",3)\n"));
  }

  fs::path folder_;
};

/// The unit square, its control points evenly spaced, at the height z = x·y where `twisted`.
std::string square_patch(bool twisted) {
  std::string text = "# a square\npatch\n";
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      text += fmt::format(" {} {} {}\n", column / 3.0, row / 3.0, twisted ? column * row / 9.0 : 0.0);
  return text;
}

TEST(Patches, InterpolateTheirCornersAndKeepPlanes) {
  const auto flat = read_patches(square_patch(false), "flat.patch");
  EXPECT_EQ(flat.size(), 2u * kPatchSteps * kPatchSteps);
  EXPECT_NEAR(area_of(flat), 1, 1e-5);
  // Bilinear control points make the bilinear surface z = xy exactly.
  for (const Triangle& triangle : read_patches(square_patch(true), "twisted.patch"))
    for (const Vec3& p : triangle) EXPECT_NEAR(p.z, p.x * p.y, 1e-6);
}

TEST(Patches, FaultsNameTheirLine) {
  const auto message = [](const std::string& text) {
    return message_of([&] { read_patches(text, "bad.patch"); });
  };
  EXPECT_EQ(message(""), "bad.patch:1: got the end of the file, expected 'patch'");
  EXPECT_EQ(message("# only\n\nspline\n"),
            "bad.patch:3: got 'spline', expected 'patch', at most 100 of them");
  EXPECT_THAT(message("patch\n1 2 3\n4 x 6\n"), HasSubstr("bad.patch:3: got 'x', expected 48 numbers"));
  EXPECT_THAT(message("patch 1 2 3"), HasSubstr("bad.patch:1: got the end of the file"));
  EXPECT_THAT(message("patch 1 nan"), HasSubstr("got 'nan'"));
  EXPECT_THAT(message("patch 1 1e9"), HasSubstr("got '1e9'"));
}

TEST_F(SurfaceFiles, PatchesArePlacedAndScaled) {
  write("own.patch", square_patch(false));
  const Plant plant = plant_of(grammar_with("own.patch"));
  EXPECT_NEAR(area_of(plant), 9 * 4, 1e-3);  // scale 3, 2 m a unit
  const Bounds box = bounds(plant);
  EXPECT_NEAR(box.lower.z, 0, 1e-5);      // the foot of the segment
  EXPECT_NEAR(box.upper.z, 2 + 6, 1e-4);  // y of the surface is the heading
  EXPECT_NEAR(box.upper.x, 6, 1e-4);      // x is to the right
}

TEST_F(SurfaceFiles, MeshesAreReadByAssimp) {
  write("own.obj", "mtllib ../secret.mtl\nv 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4\n");
  const Plant plant = plant_of(grammar_with("own.obj"));
  EXPECT_NEAR(area_of(plant), 2 * 9 * 4, 1e-3);
}

TEST_F(SurfaceFiles, BadFilesAreOneLine) {
  write("own.patch", "patch 1 2\n");
  write("own.obj", "no mesh\n");
  write("nan.obj", "v 0 0 0\nv 1 0 0\nv nan nan 0\nf 1 2 3\n");
  const auto message = [&](const std::string& file) { return message_of([&] { grammar_with(file); }); };
  EXPECT_THAT(message("own.patch"), HasSubstr("own.patch:2: got the end of the file"));
  EXPECT_THAT(message("own.obj"), HasSubstr("surface \"own.obj\""));
  EXPECT_THAT(message("nan.obj"), HasSubstr("surface \"nan.obj\""));
  EXPECT_THAT(message("nowhere.patch"), HasSubstr("nowhere.patch"));
  write("many.ply", "ply\nformat ascii 1.0\nelement vertex 99999999\nproperty float x\nend_header\n0\n");
  EXPECT_THAT(message("many.ply"), HasSubstr("got 'element vertex 99999999' in a file of"));
  for (const char* file : {"../own.patch", "/etc/passwd", "own.txt", "..\\\\own.patch", ""})
    EXPECT_THAT(message(file), HasSubstr("test.lsys:2:15: got surface")) << file;
}

TEST(Surfaces, TextsThatAreNoFilesReadNone) {
  EXPECT_NO_THROW(parse_grammar("surface p = \"petal.patch\"\naxiom: ~(\"p\")\n", "bundled.lsys"));
  EXPECT_THAT(message_of([] { parse_grammar("surface p = \"other.patch\"\naxiom: A\n", "x.lsys"); }),
              HasSubstr("x.lsys:1:13: got surface \"other.patch\", expected a bundled .patch file"));
  EXPECT_THAT(message_of([] {
                parse_grammar("surface p = \"petal.patch\"\nsurface p = \"petal.patch\"\naxiom: A\n",
                              "x.lsys");
              }),
              HasSubstr("x.lsys:2:9: got surface 'p' a second time"));
}

TEST(Surfaces, OutlinesOfTheParametricModelHaveNames) {
  for (const auto& [name, shape] : {std::pair{"ovate", 1}, {"maple", 4}, {"triangle", 10}}) {
    const LeafOutline& outline = leaf_outline(shape);
    double expected = 0;
    for (const auto& [a, b, c] : outline.triangles)
      expected += 0.5 * length(cross(outline.vertices[b] - outline.vertices[a],
                                     outline.vertices[c] - outline.vertices[a]));
    const Plant plant = plant_of(fmt::format("leaf_length: 2\nleaf_width: 3\naxiom: ~(\"{}\",0.5)\n", name));
    EXPECT_NEAR(area_of(plant), expected * 0.5 * 0.5 * 2 * 3, 1e-4) << name;
  }
  EXPECT_GT(plant_of("axiom: ~(\"magnolia\")\n").leaves.size(), 10u);
}

// [Herbaceous §6]: the edges bound triangles between neighbouring axes; the first has no length, the second
// lies on an axis. Axes of n and n + 1 internodes at the angle δ span n(n+1)/2·sin δ.
TEST(Frames, EdgesBetweenTipsFillTheCordateLeaf) {
  const Grammar grammar = parse_grammar(
      "angle: 20\nwidth: 0.01\naxiom: [A][B]\nproductions:\n p1: A --> [+A?]C#\n p2: B --> [-B?]C#\n"
      " p3: C --> IC\ninterpretation:\n I --> F\n",
      "cordate.lsys");
  for (const int steps : {3, 4, 7}) {
    double expected = 0;
    for (int n = 1; n + 1 < steps; ++n) expected += 2 * 0.5 * n * (n + 1) * std::sin(20 * M_PI / 180);
    EXPECT_NEAR(area_of(plant_of(grammar, steps)), expected, 1e-3 * expected) << steps;
  }
}

TEST(Frames, BundledLeafIsThatOfPolygonMarks) {
  const Plant frame = plant_of(load_grammar("cordate_frame"), 12);
  const Plant polygons = plant_of(load_grammar("cordate_leaf"), 12);
  EXPECT_NEAR(area_of(frame), area_of(polygons), 1e-4 * area_of(polygons));
}

// [Herbaceous §6]: each polygon is a trapezoid bounded by two regular and two inserted edges. A flat fan of
// two axes at 60° with edges after one, two and three internodes: no part is filled twice.
TEST(Frames, WebsOfEdgesBoundQuadrilaterals) {
  const std::string axis = "F?(1)F?(2)F?(3)", other = "F#(1)F#(2)F#(3)";
  const Plant plant = plant_of("angle: 60\naxiom: [" + axis + "][+" + other + "]\n");
  EXPECT_NEAR(area_of(plant), 9 * 0.5 * std::sin(M_PI / 3), 1e-4);
  EXPECT_EQ(plant.leaves.size(), 1u + 2 + 2);  // a triangle and two trapezoids
}

TEST(Frames, AnEdgeNeedsItsStart) {
  EXPECT_THAT(message_of([] { plant_of("axiom: F#\n"); }),
              HasSubstr("module 1 of the string: got '#', expected a '?' before it"));
  EXPECT_THAT(message_of([] { plant_of("axiom: ?(1)F#(2)\n"); }), HasSubstr("expected a '?' before it"));
  EXPECT_EQ(plant_of("axiom: ?F#?F\n").leaves.size(), 0u);  // a polygon without an area is none
}

constexpr PartColor kRed{255, 0, 0, true}, kGreen{0, 128, 0, true};

TEST(Colors, GoWithSegmentsLeavesAndSurfaces) {
  const Plant plant =
      plant_of("colors: ff0000 008000\naxiom: F;F~(\"leaf\")[;F]F'~(\"leaf\"),(0)F;(1,0,0.2)F\n");
  const std::vector<PartColor> expected{{}, kRed, kRed, {}, {255, 0, 51, true}, {}, kGreen, {}};
  EXPECT_EQ(plant.knots.color, expected);  // knots of the axis, then of its branch
  EXPECT_EQ(plant.leaves.color, (std::vector<PartColor>{kRed, kGreen}));
  const Plant polygon = plant_of("angle: 90\ncolors: ff0000\naxiom: {;F+F+F+F}~(\"leaf\")\n");
  for (const PartColor color : polygon.leaves.color) EXPECT_EQ(color, kRed);
  EXPECT_GT(polygon.leaves.color.size(), 2u);
}

TEST(Colors, StayInTheTable) {
  EXPECT_EQ(plant_of("colors: ff0000 008000\naxiom: ;;;;F\n").knots.color[0], kGreen);
  EXPECT_TRUE(plant_of("colors: ff0000\naxiom: ;,,,F\n").knots.color.empty());
  EXPECT_THAT(message_of([] { plant_of("colors: ff0000\naxiom: F;(2)F\n"); }),
              HasSubstr("module 1 of the string: got colour 2, expected 0 to 1"));
  EXPECT_THAT(message_of([] { plant_of("colors: ff00\naxiom: F\n"); }),
              HasSubstr("test.lsys:1:9: got 'ff00', expected a colour of six hexadecimal digits"));
  EXPECT_THAT(message_of([] { plant_of("axiom: ;(1,2)F\n"); }),
              HasSubstr("test.lsys:1:8: module ;: got 2 parameters, the turtle expects 0, 1 or 3"));
}

TEST(Colors, StringsWithoutThemHaveNone) {
  const Plant plant = plant_of("axiom: F[+F~(\"leaf\")]F{F+(90)F+(90)F}\n");
  EXPECT_TRUE(plant.knots.color.empty());
  EXPECT_TRUE(plant.leaves.color.empty());
}

TEST(Surfaces, PlantsOfManyTrianglesAreRefused) {
  const std::string many =
      "surface p = \"petal.patch\"\naxiom: S\nproductions:\n S --> lua\n   for i = 1, 80000 do produce('Q') "
      "end\n"
      "interpretation:\n Q --> ~(\"p\")\n";
  EXPECT_THAT(message_of([&] { plant_of(many, 1); }),
              HasSubstr("test.lsys: got more than 1e+09 units of work"));
  const auto with_much_work = [&] {
    const Grammar grammar = parse_grammar(many, "test.lsys");
    Derivation derivation(grammar);
    derivation.start(1);
    derivation.run(1);
    Plant plant;
    Work work("test.lsys", 1e12);
    build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant, work);
  };
  EXPECT_THAT(message_of(with_much_work), HasSubstr("test.lsys: got more than 5000000 leaves and triangles"));
}

}  // namespace
}  // namespace espalier::lsystem
