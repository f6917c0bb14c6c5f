// Plants of other L-systems, grown once and copied: instancing, and the knot garden made by it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <espalier/lsystem/derivation/derivation.h>
#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/bundled.h>
#include <espalier/lsystem/files/grammar_file.h>

namespace espalier::lsystem {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Copies : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  Plant plant_of(const std::string& text, PlantJoints* joints = nullptr) {
    const Grammar grammar = parse_grammar(text, "host.lsys", folder_);
    Derivation derivation(grammar);
    derivation.start(1);
    derivation.run(derivation.settings().steps);
    Plant plant;
    build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant, joints);
    return plant;
  }

  std::string message_of(const std::string& text) {
    try {
      plant_of(text);
      return "no error";
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("espalier_copies_{}", ::getpid());
};

void expect_same(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(length(a[i] - b[i]), 1e-5f) << i;
}

void expect_same(const PlantJoints& a, const PlantJoints& b) {
  EXPECT_EQ(a.organ_of_leaf, b.organ_of_leaf);
  ASSERT_EQ(a.organs.size(), b.organs.size());
  for (std::size_t i = 0; i < a.organs.size(); ++i) {
    EXPECT_EQ(a.organs[i].stem, b.organs[i].stem) << i;
    EXPECT_EQ(a.organs[i].place.knot, b.organs[i].place.knot) << i;
  }
  ASSERT_EQ(a.stem_place.size(), b.stem_place.size());
  for (std::size_t s = 0; s < a.stem_place.size(); ++s)
    EXPECT_EQ(a.stem_place[s].knot, b.stem_place[s].knot) << s;
}

constexpr const char* kTwig =
    "steps: 1\nwidth: 0.1\nparam turn = 30 in 0 .. 90\naxiom: X\nproductions:\n"
    " X --> F[+(turn);(0.5,0,1)F~(\"leaf\",0.5)]F~(\"blossom\",0.3)\n";

TEST_F(Copies, AreWhatTheirStringWouldDrawInTheirPlace) {
  write("twig.lsys", kTwig);
  const std::string head = "unit: 2\nwidth: 0.1\nplant twig = \"twig.lsys\"\n";
  PlantJoints joints, written_joints;
  const Plant copied = plant_of(head + "axiom: F[&(40)/(20)F[~(\"twig\")]F(2)]\n", &joints),
              written = plant_of(
                  head + "axiom: F[&(40)/(20)F[F[+(30);(0.5,0,1)F~(\"leaf\",0.5)]F~(\"blossom\",0.3)]F(2)]\n",
                  &written_joints);
  EXPECT_EQ(copied.stems.parent, written.stems.parent);
  ASSERT_EQ(copied.knots.size(), written.knots.size());
  for (std::size_t k = 0; k < copied.knots.size(); ++k)
    EXPECT_FLOAT_EQ(copied.knots.radius_m[k], written.knots.radius_m[k]);
  EXPECT_EQ(copied.knots.color, written.knots.color);
  EXPECT_EQ(copied.leaves.color, written.leaves.color);
  EXPECT_EQ(copied.leaves.kind, written.leaves.kind);
  expect_same(copied.knots.point_m, written.knots.point_m);
  expect_same(copied.knots.handle_out_m, written.knots.handle_out_m);
  expect_same(copied.leaves.position_m, written.leaves.position_m);
  expect_same(copied.leaves.axis, written.leaves.axis);
  expect_same(copied.leaves.side, written.leaves.side);
  expect_same(joints, written_joints);
}

TEST_F(Copies, HaveTheShadesOfTheirPolygons) {
  write("blade.lsys", "leaf_shape: 10\naxiom: {.F+(60)F+(60)F+(60)F}\n");
  for (const char* head : {"leaf_shape: 10\n", "leaf_shape: 3\n"}) {
    const Plant plant =
        plant_of(std::string(head) + "plant blade = \"blade.lsys\"\naxiom: ~(\"blade\")F~(\"leaf\")\n");
    ASSERT_EQ(plant.leaves.shade.size(), plant.leaves.size());
    EXPECT_EQ(std::count(plant.leaves.shade.begin(), plant.leaves.shade.end(), kPlainShade), 3);
  }
}

TEST_F(Copies, TakeParametersAndSeeds) {
  write("twig.lsys", kTwig);
  const Plant straight = plant_of("plant a = \"twig.lsys\" turn=0\naxiom: ~(\"a\")\n");
  EXPECT_NEAR(bounds(straight).upper.z, 2.5, 0.3);
  for (const Vec3& point : straight.knots.point_m) EXPECT_NEAR(point.x, 0, 1e-6);
  write("chance.lsys", "axiom: F(1 + random())\n");
  const auto height = [&](int seed) {
    return plant_of(fmt::format("plant a = \"chance.lsys\" seed={}\naxiom: ~(\"a\")\n", seed)).tree_scale_m;
  };
  EXPECT_EQ(height(1), height(1));
  EXPECT_NE(height(1), height(2));
}

TEST_F(Copies, ScaleWithTheirModule) {
  write("twig.lsys", kTwig);
  const Plant one = plant_of("plant a = \"twig.lsys\"\naxiom: ~(\"a\")\n"),
              three = plant_of("plant a = \"twig.lsys\"\naxiom: ~(\"a\", 3)\n");
  ASSERT_EQ(one.knots.size(), three.knots.size());
  for (std::size_t k = 0; k < one.knots.size(); ++k) {
    EXPECT_LT(length(one.knots.point_m[k] * 3 - three.knots.point_m[k]), 1e-5f);
    EXPECT_NEAR(one.knots.radius_m[k] * 3, three.knots.radius_m[k], 1e-6);
  }
  EXPECT_NEAR(one.leaves.length_m[0] * 3, three.leaves.length_m[0], 1e-6);
}

// Plants hold leaves of one outline: others are copied as triangles.
TEST_F(Copies, LeavesOfAnotherShapeKeepTheirs) {
  write("twig.lsys", std::string("leaf_shape: 4\n") + kTwig);
  const Plant maple = plant_of("leaf_shape: 4\nplant a = \"twig.lsys\"\naxiom: ~(\"a\")\n"),
              other = plant_of("leaf_shape: 2\nplant a = \"twig.lsys\"\naxiom: ~(\"a\")\n");
  EXPECT_EQ(maple.leaves.size(), 2u);
  EXPECT_GT(other.leaves.size(), 10u);
  const Bounds a = bounds(maple), b = bounds(other);
  EXPECT_LT(length(a.upper - b.upper) + length(a.lower - b.lower), 1e-4f);
}

TEST_F(Copies, FaultsAreOneLineWithTheirPlace) {
  write("twig.lsys", kTwig);
  write("self.lsys", "plant a = \"self.lsys\"\naxiom: ~(\"a\")\n");
  write("bad.lsys", "axiom: A[\n");
  write("wild.lsys", "steps: 100\naxiom: A\nproductions:\n A --> AA\n");
  write("loop.lsys", "axiom: A\nlua:\n  while true do end\n");
  fs::create_directories(folder_ / "folder.lsys");
  const std::pair<std::string, std::string> faults[] = {
      {"\"nowhere.lsys\"", "host.lsys:1:11: "},
      {"\"../twig.lsys\"", "host.lsys:1:11: got file \"../twig.lsys\""},
      {"\"twig.obj\"", "host.lsys:1:11: got file \"twig.obj\", expected one that ends with .lsys"},
      {"\"folder.lsys\"", "host.lsys:1:11: "},
      {"\"self.lsys\"", "got a plant in an L-system that is a plant of another, expected none"},
      {"\"bad.lsys\"", "bad.lsys:1:9: got '['"},
      {"\"wild.lsys\"", "more than 3000000 modules"},
      {"\"loop.lsys\"", "instructions"},
      {"\"twig.lsys\" turn=100", "100"},
      {"\"twig.lsys\" twist=3", "host.lsys:1:23: got twist=3, expected a parameter of twig, or a seed"},
      {"\"twig.lsys\" turn", "expected '='"},
      {"\"twig.lsys\" seed=x", "expected a number"},
      {"\"twig.lsys\"\nplant a = \"twig.lsys\"", "host.lsys:2:7: got surface 'a' a second time"},
      {"twig", "host.lsys:1:11: got 't', expected '\"'"}};
  for (const auto& [declaration, expected] : faults)
    EXPECT_THAT(message_of("plant a = " + declaration + "\naxiom: F\n"), HasSubstr(expected)) << declaration;
  std::string many;
  for (int i = 0; i < 17; ++i) many += fmt::format("plant p{} = \"twig.lsys\"\n", i);
  EXPECT_THAT(message_of(many + "axiom: F\n"), HasSubstr("got more than 16 plants"));
}

TEST(CopiesOfTexts, ThatAreNoFilesAreRefused) {
  EXPECT_THROW(parse_grammar("plant a = \"knot_plant.lsys\"\naxiom: F\n", "any.lsys"), InputError);
}

/// Distance from the nearest path of the garden: lines of squares, circles in them, trees in their middles.
double distance_to_path(double x, double y, double edge, double radius, bool odd_columns) {
  const auto to_line = [&](double v, bool odd) {
    const double shifted = v / edge + (odd ? 0.5 : 0);
    return edge * std::fabs(shifted - std::round(shifted));
  };
  const double u = to_line(x, odd_columns), v = to_line(y, false);  // from the nearest lines
  const double middle = std::hypot(edge / 2 - u, edge / 2 - v);
  return std::min({u, v, std::fabs(middle - radius), std::max(0.0, middle - 7)});
}

// [Topiary, Fig. 12]: hedges fill their paths and keep to them.
TEST(KnotGarden, IsGreenAlongItsPathsOnly) {
  const Grammar grammar = load_grammar("knot_garden");
  Derivation derivation(grammar);
  derivation.start(1);
  derivation.run(1);
  Plant plant;
  build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant);
  const double unit_m = derivation.settings().unit_m;
  std::size_t far = 0;
  for (const Vec3& point : plant.leaves.position_m)
    far += distance_to_path(point.x / unit_m, point.y / unit_m, 60, 21, true) > 3 + 2;
  EXPECT_EQ(far, 0u);
  // Every unit of every circle and line has leaves near it.
  for (int column = -1; column <= 1; ++column)
    for (int angle_deg = 0; angle_deg < 360; angle_deg += 10) {
      const double angle_rad = angle_deg * 0.017453292519943295;
      const Vec3 place{static_cast<float>(60 * column + 21 * std::cos(angle_rad)),
                       static_cast<float>(30 + 21 * std::sin(angle_rad)), 2};
      const bool covered = std::any_of(
          plant.leaves.position_m.begin(), plant.leaves.position_m.end(),
          [&](const Vec3& point) { return length(point * static_cast<float>(1 / unit_m) - place) < 4; });
      EXPECT_TRUE(covered) << column << " " << angle_deg;
    }
}

}  // namespace
}  // namespace espalier::lsystem
