// Laws of volumes of volumes, of signed distances, and of volumes as text.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include <espalier/environment/picture_envelope.h>
#include <espalier/environment/volume_tree.h>
#include <espalier/image/pictures/picture.h>

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCube =
    "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\n"
    "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\nf 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 "
    "8 6\n";

fs::path file(const std::string& name, const std::string& text) {
  // Of this process: tests of other builds may run at the same time.
  const fs::path path =
      fs::temp_directory_path() / fmt::format("espalier_volume_tree_{}_{}", ::getpid(), name);
  std::ofstream(path) << text;
  return path;
}

Vec3 any_point() {
  const auto number = [] { return static_cast<float>(*rc::gen::inRange(-4000, 4001)) / 1000; };
  return {number(), number(), number()};
}

const std::vector<std::string>& samples() {
  static const std::vector<std::string> texts{
      "box(0,0,0, 2,3,4)",
      "ball(1,0,0, 2)",
      "cylinder(0,0,-1, 1.5,3)",
      "ellipsoid(0,0,0, 1,2,3)",
      "line(-2,0,0, 2,1,1, 1,0.5)",
      "spiral(0,0,-3, 6,3, 2,0.7, 0.7)",
      "union(ball(0,0,0, 1), box(2,0,0, 1,1,1))",
      "intersection(ball(0,0,0, 2), box(1,0,0, 2,2,2))",
      "difference(ball(0,0,0, 2), ball(1,0,0, 1))",
      "blend(0.5, ball(-1,0,0, 1), ball(1,0,0, 1))",
      "moved(1,1,0, turned(30, scaled(2, box(0,0,0, 1,0.5,1))))",
      "crown(top = 3, bottom = -2, radius = 2, rim_left = 2, top_x = 1)",
      fmt::format("mesh(\"{}\")", file("cube.obj", kCube).string())};
  return texts;
}

RC_GTEST_PROP(VolumeTree, DistancesAreNegativeExactlyInside, ()) {
  const auto volume = parse_volume(*rc::gen::elementOf(samples()));
  const Vec3 point = any_point();
  const float distance_m = volume->signed_distance_m(point);
  if (std::fabs(distance_m) > 1e-4f) RC_ASSERT(volume->contains(point) == (distance_m < 0));
}

RC_GTEST_PROP(VolumeTree, DistancesOfExactVolumesChangeNoFasterThanThePointMoves, ()) {
  const auto volume = parse_volume(*rc::gen::element(samples()[0], samples()[1], samples()[2], samples()[6],
                                                     samples()[7], samples()[8], samples().back()));
  const Vec3 a = any_point(), b = any_point();
  RC_ASSERT(std::fabs(volume->signed_distance_m(a) - volume->signed_distance_m(b)) <=
            length(a - b) * 1.0001f + 1e-5f);
}

RC_GTEST_PROP(VolumeTree, AMeshOfABoxHasTheBoxesDistances, ()) {
  const auto mesh = parse_volume(samples().back()), box = parse_volume("box(0,0,0, 2,2,2)");
  const Vec3 point = any_point();
  RC_ASSERT(std::fabs(mesh->signed_distance_m(point) - box->signed_distance_m(point)) < 1e-4f);
}

RC_GTEST_PROP(VolumeTree, SetsOfPointsAreWhatTheirNamesSay, ()) {
  const auto a = parse_volume(samples()[0]), b = parse_volume(samples()[1]);
  const auto of = [](const char* kind) {
    return parse_volume(fmt::format("{}({}, {})", kind, samples()[0], samples()[1]));
  };
  const Vec3 p = any_point();
  RC_ASSERT(of("union")->contains(p) == (a->contains(p) || b->contains(p)));
  RC_ASSERT(of("intersection")->contains(p) == (a->contains(p) && b->contains(p)));
  RC_ASSERT(of("difference")->contains(p) == (a->contains(p) && !b->contains(p)));
}

TEST(VolumeTree, ABlendHoldsItsPartsAndFillsTheirJoint) {
  const auto blend = parse_volume("blend(1, ball(-1.2,0,0, 1), ball(1.2,0,0, 1))");
  const auto joined = parse_volume("union(ball(-1.2,0,0, 1), ball(1.2,0,0, 1))");
  EXPECT_FALSE(joined->contains({0, 0, 0}));
  EXPECT_TRUE(blend->contains({0, 0, 0}));
  for (float x = -2.1f; x < 2.2f; x += 0.1f)
    EXPECT_TRUE(!joined->contains({x, 0, 0}) || blend->contains({x, 0, 0}));
  EXPECT_NEAR(blend->signed_distance_m({9, 0, 0}), 6.8, 1e-4);
  // A part alone keeps its surface.
  const auto alone = parse_volume("blend(1, ball(0,0,0, 1))");
  for (const float x : {0.3f, 0.9f, 1.f, 1.5f, 3.f})
    EXPECT_NEAR(alone->signed_distance_m({x, 0, 0}), x - 1, 1e-4);
}

TEST(VolumeTree, TurnsOfAShellAreShrunkCopies) {
  const auto shell = parse_volume("spiral(0,0,0, 10,3, 4,1, 0.5)");
  // Heights of the tube's middle at whole turns: 10 (1 - 0.5^n) / (1 - 0.5^3).
  for (int n = 0; n <= 3; ++n) {
    const float scale = std::pow(0.5f, static_cast<float>(n)), z = 10 * (1 - scale) / (1 - 0.125f);
    EXPECT_NEAR(shell->signed_distance_m({4 * scale, 0, z}), -scale, 1e-4) << n;
    EXPECT_NEAR(shell->signed_distance_m({4 * scale - scale, 0, z}), 0, 1e-4) << n;
  }
}

TEST(VolumeTree, APictureIsAVolumeOfTheHeightAsked) {
  Mask mask(64, 64);
  for (int y = 10; y < 50; ++y)
    for (int x = 22; x < 42; ++x) mask.set(x, y);
  const fs::path path = file("mask.png", "");
  write_mask_png(path, mask);
  const auto volume = parse_volume(fmt::format("picture(\"{}\", 8)", path.string()));
  EXPECT_TRUE(volume->contains({0, 0, 4}));
  EXPECT_TRUE(volume->contains({1.9f, 0, 7.8f}));
  EXPECT_FALSE(volume->contains({2.1f, 0, 4}));
  EXPECT_FALSE(volume->contains({0, 0, 8.2f}));
  EXPECT_FALSE(volume->contains({0, 2.2f, 4}));
  EXPECT_NEAR(volume->signed_distance_m({4, 0, 4}), 2, 0.15);
  EXPECT_NEAR(volume->signed_distance_m({0, 0, 12}), 4, 0.15);
  EXPECT_NEAR(volume->signed_distance_m({1.5f, 0, 4}), -0.5, 0.15);
}

std::string error_of(const std::string& text) {
  try {
    parse_volume(text);
    return "none";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(VolumeTree, ErrorsNameColumnGotAndExpected) {
  const fs::path open = file("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
                 text = file("text.png", "no picture");
  const fs::path many =
      file("many.ply", "ply\nformat ascii 1.0\nelement vertex 99999999\nproperty float x\nend_header\n0\n");
  const std::pair<std::string, std::string> faults[] = {
      {"cube(0,0,0, 1)",
       "column 1: got the unknown volume 'cube', expected one declared before, or one of box"},
      {"ball(0,0,0)", "column 11: got ')', expected ',': ball(x,y,z, r)"},
      {"ball(0,0,0, 1, 2)", "column 14: got ',', expected ')': ball(x,y,z, r)"},
      {"ball(0,0,0, x)", "column 13: 'x' is not a finite number"},
      {"ball(0,0,0, -1)", "column 1: ball: radius is -1, expected a positive number"},
      {"union(ball(0,0,0, 1), )", "column 23: got ')', expected a volume"},
      {"union()", "column 7: got ')', expected a volume"},
      {"difference(ball(0,0,0, 1))", "column 26: got ')', expected ','"},
      {"box(0,0,0, 1,1,1) x", "column 19: got 'x', expected the end of the volume"},
      {"mesh(rock)", "column 6: got 'r', expected '\"'"},
      {"mesh(\"nowhere.obj\")", "nowhere.obj': no such file"},
      {fmt::format("mesh(\"{}\")", open.string()), "3 of 3 edges are open"},
      {fmt::format("mesh(\"{}\")", many.string()), "got 'element vertex 99999999' in a file of"},
      {fmt::format("picture(\"{}\", 3)", text.string()), "_text.png"},
      {"spiral(0,0,0, 1,1, 1,1, 2)", "spiral: shrink is 2"}};
  for (const auto& [fault, expected] : faults)
    EXPECT_NE(error_of(fault).find(expected), std::string::npos) << fault << "\n" << error_of(fault);
  std::string deep = "ball(0,0,0,1)";
  for (int i = 0; i < 1000; ++i) deep = "union(" + deep + ")";
  EXPECT_NE(error_of(deep).find("expected volumes in fewer volumes"), std::string::npos);
}

}  // namespace
}  // namespace espalier
