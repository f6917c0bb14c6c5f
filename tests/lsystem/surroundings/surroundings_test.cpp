// What L-systems sense of their surroundings: volumes, fields, light.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/bundled.h>
#include <espalier/lsystem/files/grammar_file.h>
#include <espalier/lsystem/files/model.h>

#include "support/strings.h"

namespace espalier::lsystem {
namespace {

namespace fs = std::filesystem;

std::string after_one_step(const std::string& declarations, const std::string& production) {
  return strings_of(declarations + "\naxiom: A\nproductions:\n " + production + "\n", 1).back();
}

TEST(Surroundings, ExpressionsSeeVolumes) {
  const std::string clip =
      "param r = 2 in 1 .. 3\nvolume core = ball(0,0,0, r)\n"
      "volume clip = difference(box(0,0,0, 8,8,8), core)";
  EXPECT_EQ(after_one_step(clip, "A --> B(distance(core, 5, 0, 0))"), "B(3)");
  EXPECT_EQ(after_one_step(clip, "A --> B(distance(clip, 3, 0, 0))"), "B(-1)");
  EXPECT_EQ(after_one_step(clip, "A : inside(clip, 3, 0, 0) --> B"), "B");
  EXPECT_EQ(after_one_step(clip, "A : inside(clip, 1, 0, 0) --> B"), "A");
  EXPECT_EQ(after_one_step(clip, "A --> B(inside(clip, 3, 0, 0) and 7 or 8)"), "B(7)");
}

TEST(Surroundings, NamedNumbersOfACrownAreExpressions) {
  const std::string clip =
      "param r = 2 in 1 .. 3\nvolume clip = crown(radius = max(r, 1), top = 2*r, rim = 1)";
  EXPECT_EQ(after_one_step(clip, "A : inside(clip, 1.9, 0, 1) --> B"), "B");
  EXPECT_EQ(after_one_step(clip, "A : inside(clip, 2.1, 0, 1) --> B"), "A");
  EXPECT_EQ(after_one_step(clip, "A : inside(clip, 0, 0, 3.9) --> B"), "B");
}

TEST(Surroundings, LuaSeesTheSame) {
  const std::string clip =
      "volume clip = ball(0,0,0, 2)\nlua:\n  function at(x) return distance(clip, x, 0, 0) end";
  EXPECT_EQ(after_one_step(clip, "A --> B(at(5))"), "B(3)");
  EXPECT_EQ(
      after_one_step(clip, "A --> lua\n   if inside(clip, 1, 0, 0) then produce(\"C\", light(0, 0, 0)) end"),
      "C(1)");
}

TEST(Surroundings, ALetFunctionOfTheFileComesFirst) {
  EXPECT_EQ(after_one_step("let distance(x) = 2*x", "A --> B(distance(3))"), "B(6)");
}

TEST(Surroundings, VolumesFollowTheParametersOfEachDerivation) {
  const Grammar grammar = parse_grammar(
      "param r = 2 in 1 .. 3\nvolume clip = ball(0,0,0, r)\naxiom: B(distance(clip, 5, 0, 0))\n", "v.lsys");
  Derivation derivation(grammar);
  for (const double r : {2.0, 1.0, 3.0}) {
    derivation.start(std::vector{r}, 1);
    EXPECT_EQ(derivation.text(), fmt::format("B({})", 5 - r));
  }
  derivation.replace_volume("clip", make_ball({1, 0, 0}, 1));
  derivation.start(1);
  EXPECT_EQ(derivation.text(), "B(3)");
  derivation.replace_volume("clip", nullptr);
  derivation.start(1);
  EXPECT_EQ(derivation.text(), "B(3)");
  EXPECT_THROW(derivation.replace_volume("clop", make_ball({1, 0, 0}, 1)), InputError);
}

/// How much sun and sky reaches (0,0,1), beside what `drawn` draws.
std::pair<double, double> light_at(const std::string& settings, const std::string& drawn) {
  const std::string text =
      settings + "\naxiom: " + drawn + "A\nproductions:\n A --> B(light(0,0,1), skylight(0,0,1))\n";
  const std::string string = strings_of(text, 1).back();
  double sun = -1, sky = -1;
  std::sscanf(string.c_str() + string.find("B("), "B(%lf,%lf)", &sun, &sky);
  return {sun, sky};
}

TEST(Surroundings, ThePlantKeepsLightAway) {
  const auto [sun, sky] = light_at("sun: 0, 0, 1", "");
  EXPECT_EQ(sun, 1);
  EXPECT_EQ(sky, 1);
  // A thick segment across, two units above the place.
  const auto [under, some] = light_at("sun: 0, 0, 1", "f(3)+(90)f(2)|F(4,1)");
  EXPECT_EQ(under, 0);
  EXPECT_LT(some, 0.9);
  EXPECT_GT(some, 0.4);
  EXPECT_EQ(light_at("sun: 1, 0, 0.1", "f(3)+(90)f(2)|F(4,1)").first, 1);
}

TEST(Surroundings, VolumesKeepLightAwayWhereTheFileSaysSo) {
  const std::string wall = "sun: 1, 0, 0\nvolume wall = box(3,0,0, 1,10,10)\n";
  EXPECT_EQ(light_at(wall, "").first, 1);
  EXPECT_EQ(light_at(wall + "shade: wall", "").first, 0);
  const double sky = light_at(wall + "shade: wall", "").second;
  EXPECT_LT(sky, 0.95);
  EXPECT_GT(sky, 0.5);
}

TEST(Surroundings, TheSunIsAUnitVector) {
  EXPECT_EQ(after_one_step("sun: 3, 0, 4", "A --> B(sun_x, sun_y, sun_z)"), "B(0.6,0,0.8)");
}

std::string message_of(const std::string& text) {
  try {
    strings_of(text, 1);
    return "no error";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Surroundings, FaultsAreOneLineWithTheirPlace) {
  const std::string end = "\naxiom: A\n";
  const std::pair<std::string, std::string> faults[] = {
      {"volume clip = cube(1)" + end, "test.lsys:1:15: got the unknown volume 'cube'"},
      {"volume clip = ball(0,0,0)" + end, "test.lsys:1:25: got ')', expected ','"},
      {"volume clip = union(core, ball(0,0,0,1))" + end, "test.lsys:1:21: got the unknown volume 'core'"},
      {"volume clip = ball(0,0,0, 1-1)" + end, "test.lsys:1:15: ball: radius is 0"},
      {"volume clip = ball(0,0,0, 1/0)" + end, "test.lsys:1:27: '1/0' is no finite number"},
      {"volume clip = crown(top = 2-3, radius = 1)" + end,
       "test.lsys:1:15: crown: top is -1, expected more than its bottom, 0"},
      {"volume clip = crown(top = 2, radius = 1/0)" + end, "test.lsys:1:39: '1/0' is no finite number"},
      {"volume clip = ball(0,0,0, r)" + end, "test.lsys:1:27: 'r': got the unknown name 'r'"},
      {"volume clip = mesh(\"a.obj\")" + end, "test.lsys:1:21: got file \"a.obj\", expected none"},
      {"volume c = ball(0,0,0,1)\nvolume c = ball(0,0,0,1)" + end, "test.lsys:2:8: got 'c' a second time"},
      {"field soil = picture(\"a.png\", 0, 0, 1)" + end, "test.lsys:1:23: got file \"a.png\", expected none"},
      {"const a = inside(c, 0,0,0) and 1 or 0\nvolume c = ball(0,0,0,1)" + end,
       "got a volume before its declaration"},
      {"axiom: B(inside(clop, 0,0,0) and 1 or 0)\n",
       "test.lsys:1:10: 'inside(clop, 0,0,0) and 1 or 0': got the unknown name 'clop'"},
      {"volume c = ball(0,0,0,1)\naxiom: B(distance(c, 0, 0))\n", "expected"},
      {"volume c = ball(0,0,0,1)\naxiom: B(distance(3, 0, 0, 0))\n", "expected the name of a volume"},
      {"volume c = ball(0,0,0,1)\naxiom: B(c + 1)\n", "test.lsys:2:"},
      {"sun: 0, 1" + end, "sun: got 2 numbers, expected 3"},
      {"sun: 0, 0, 0" + end, "is no finite number"},
      {"shade: wall" + end, "test.lsys:1:8: got the unknown volume 'wall'"}};
  for (const auto& [text, expected] : faults)
    EXPECT_NE(message_of(text).find(expected), std::string::npos) << text << "\n" << message_of(text);
}

TEST(Surroundings, FilesAreReadFromTheFolderOnly) {
  const fs::path folder = fs::temp_directory_path() / "espalier_surroundings";
  fs::remove_all(folder);
  fs::create_directories(folder / "deeper");
  std::ofstream(folder / "open.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(folder / "text.png") << "no picture";
  const auto message = [&](const std::string& line) -> std::string {
    std::ofstream(folder / "a.lsys") << line << "\naxiom: A\n";
    try {
      read_grammar((folder / "a.lsys").string());
      return "no error";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  for (const char* name : {"/etc/passwd", "../a.obj", "deeper/a.obj", "", ".hidden.obj"})
    EXPECT_NE(message(fmt::format("volume v = mesh(\"{}\")", name)).find("a.lsys:1:18: got file"),
              std::string::npos)
        << message(fmt::format("volume v = mesh(\"{}\")", name));
  EXPECT_NE(message("volume v = mesh(\"no.obj\")").find("a.lsys:1:18: mesh"), std::string::npos);
  EXPECT_NE(message("volume v = mesh(\"open.obj\")").find("edges are open"), std::string::npos);
  EXPECT_NE(message("volume v = picture(\"text.png\", 3)").find("a.lsys:1:21: "), std::string::npos);
  for (const char* pipe : {"pipe.png", "pipe.lsys", "pipe.patch"})
    ASSERT_EQ(::mkfifo((folder / pipe).c_str(), 0600), 0);
  EXPECT_NE(message("field f = picture(\"pipe.png\", 0,0,1)").find("is a pipe or a device"),
            std::string::npos);
  for (const char* line : {"include \"pipe.lsys\"", "plant p = \"pipe.lsys\"", "surface s = \"pipe.patch\""})
    EXPECT_NE(message(line).find("is a pipe or a device"), std::string::npos) << line;
  EXPECT_NE(message("field f = picture(\"no.png\", 0,0,1)").find("a.lsys:1:20: "), std::string::npos);
  fs::remove_all(folder);
}

Plant plant_of(const Grammar& grammar, std::span<const double> values, int steps, Seed seed) {
  Derivation derivation(grammar);
  derivation.start(values, seed);
  derivation.run(steps);
  Plant plant;
  build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant);
  return plant;
}

// [Topiary, Fig. 8 to 11]: shapes are filled up to their surface, and branches end a step beyond it.
TEST(Surroundings, TopiaryFillsItsVolume) {
  for (const char* name : {"topiary_6", "topiary_union", "topiary_spiral", "topiary_dinosaur"}) {
    SCOPED_TRACE(name);
    const Grammar grammar = load_grammar(name);
    Derivation derivation(grammar);
    derivation.start(3);
    const VolumePtr clip = derivation.volume("clip");
    derivation.run(derivation.settings().steps);
    Plant plant;
    build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant);
    const double unit_m = derivation.settings().unit_m;
    std::size_t near_surface = 0;
    for (const Vec3& point : plant.knots.point_m) {
      const float outside = clip->signed_distance_m(point * static_cast<float>(1 / unit_m));
      EXPECT_LT(outside, 1.5f);
      near_surface += outside > -2;
    }
    EXPECT_GT(near_surface, plant.knots.point_m.size() / 3);
  }
}

// [Blender thesis, listing 5.7]: branches are cut where they come near the mesh's surface.
TEST(Surroundings, BranchesStayAwayFromTheMesh) {
  const Grammar grammar = load_grammar("obstacle");
  const Plant plant = plant_of(grammar, grammar.parameters.defaults(), 12, 1);
  const Plant free = plant_of(grammar, std::vector{0.1, -8.0, 0.0}, 12, 1);
  const auto box = make_box({6, 0, 9}, {8, 8, 8});
  for (const Vec3& point : plant.knots.point_m) EXPECT_GT(box->signed_distance_m(point * 5), -0.2f);
  EXPECT_LT(plant.stems.size(), free.stems.size());
}

// [Blender thesis, Fig. 5.11]: the tree on richer soil is denser.
TEST(Surroundings, RichSoilGrowsMore) {
  const Grammar grammar = load_grammar("nutrients");
  const Plant rich = plant_of(grammar, std::vector{6.0, 1.0}, 12, 2),
              poor = plant_of(grammar, std::vector{-8.0, -5.0}, 12, 2);
  EXPECT_GT(rich.leaves.size(), 2 * poor.leaves.size());
  EXPECT_GT(rich.stems.size(), 2 * poor.stems.size());
}

TEST(Surroundings, ATreeBehindAWallIsSmallerThanOneInTheSun) {
  const Grammar grammar = load_grammar("phototropism_shade");
  const Plant open = plant_of(grammar, std::vector{-12.0, 0.5}, 10, 1),
              shaded = plant_of(grammar, std::vector{-2.0, 0.5}, 10, 1);
  EXPECT_GT(open.stems.size(), shaded.stems.size());
}

TEST(Surroundings, PruneToReplacesTheVolumeCalledClip) {
  const auto model = make_model("topiary_6");
  GrowthSettings settings;
  const auto ball = make_ball({0, 0, 0.5f}, 0.5f);
  settings.prune_to = ball.get();
  Plant pruned, whole;
  const ParameterValues values = model->table().defaults();
  model->generate(values, 1, settings, pruned);
  for (const Vec3& point : pruned.knots.point_m) EXPECT_LT(ball->signed_distance_m(point), 0.15f);
  // The next one is not pruned to it.
  model->generate(values, 1, {}, whole);
  EXPECT_GT(whole.stems.size(), pruned.stems.size());
  EXPECT_THROW(make_model("fern")->generate(make_model("fern")->table().defaults(), 1, settings, pruned),
               InputError);
}

}  // namespace
}  // namespace espalier::lsystem
