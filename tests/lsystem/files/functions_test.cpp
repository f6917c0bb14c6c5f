// Functions by numbers and from function files of vlab, in expressions and in Lua, and as parameters.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <espalier/core/curves/func_file.h>
#include <espalier/core/files.h>
#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/bundled.h>
#include <espalier/lsystem/files/model.h>

#include "support/strings.h"

namespace espalier::lsystem {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string message_of(const std::string& text, const fs::path& folder = {}) {
  try {
    strings_of(parse_grammar(text, "test.lsys", folder), 1);
    return "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
}

class FunctionFiles : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("espalier_functions_{}", ::getpid());
};

TEST(Functions, AreTheirCurveInProgramsAndInLua) {
  const std::string head = "function f = [0, 0.2, 1, 3]\naxiom: A(0.3)\nproductions:\n  A(x) --> ";
  const std::vector<double> numbers{0, 0.2, 1, 3};
  const std::string expected = fmt::format("B({:.6g})", curve_value(make_curve(numbers), 0.3));
  EXPECT_EQ(strings_of(head + "B(f(x))\n", 1).back(), expected);
  EXPECT_EQ(strings_of(head + "lua\n    produce(\"B\", f(x))\n", 1).back(), expected);
  EXPECT_EQ(strings_of("let twice(x) = 2*f(x)/2\n" + head + "B(twice(x))\n", 1).back(), expected);
  EXPECT_EQ(strings_of(head + "B((f(x)))\n", 1).back(), expected);
  EXPECT_EQ(strings_of(head + "B(({f(x)})[1])\n", 1).back(), expected);
}

TEST(Functions, StayAtTheirEndsOutside) {
  EXPECT_EQ(strings_of("function f = [2, 0, 0, 5]\naxiom: A(f(-3),f(0),f(1),f(7))\n", 0).back(),
            "A(2,2,5,5)");
  EXPECT_EQ(strings_of("function f = [4]\naxiom: A(f(0),f(0.4),f(1))\n", 0).back(), "A(4,4,4)");
}

TEST(Functions, WithBoundsAreParameters) {
  const Grammar grammar = parse_grammar(
      "function f = [0, 0.2, 1, 1] in 0 .. 2 \"how long\"\nparam p = 1 in 0 .. 3\nfunction g = [5]\n"
      "axiom: A(f(0),f(1),p,g(0.5))\n",
      "test.lsys");
  const ParameterTable& table = grammar.parameters;
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_EQ(table.rows[1].name, "f_2");
  EXPECT_EQ(table.rows[1].default_value, 0.2);
  EXPECT_EQ(table.rows[1].upper, 2);
  EXPECT_EQ(table.rows[1].help, "f at 0.333: how long");
  EXPECT_TRUE(table.rows[3].free_by_default);
  Derivation derivation(grammar);
  ParameterValues values = table.defaults();
  values[0] = 2;
  values[3] = 0.5;
  derivation.start(values, 1);
  EXPECT_EQ(derivation.text(), "A(2,0.5,1,5)");
  derivation.start(1);
  EXPECT_EQ(derivation.text(), "A(0,1,1,5)");
}

TEST_F(FunctionFiles, AreFollowedByTheNearestNumbers) {
  write("bend.func", "range: 0 1\npoints: 4\n0 1\n0.1 3\n0.5 0\n1 2\n");
  const std::vector<PlanePoint> points = read_func_points(read_file(folder_ / "bend.func"), "bend.func");
  const Grammar grammar = parse_grammar(
      "function f = \"bend.func\" in -1 .. 4\naxiom: A(f(0),f(0.37),f(1))\n", "test.lsys", folder_);
  ASSERT_EQ(grammar.functions.size(), 1u);
  EXPECT_EQ(grammar.parameters.rows.size(), 7u);
  EXPECT_GT(grammar.functions[0].error, 0);
  EXPECT_LT(grammar.functions[0].error, 0.1);
  Derivation derivation(grammar);
  derivation.start(1);
  const double* values = derivation.string().values.data();
  EXPECT_EQ(values[0], 1);
  EXPECT_NEAR(values[1], func_value(points, 0.37), grammar.functions[0].error);
  EXPECT_EQ(values[2], 2);
}

TEST_F(FunctionFiles, OfOtherKindsAreRefusedInOneLine) {
  write("new.func", "fver 9 1\nname: x\npoints: 4\n");
  write("nan.func", "range: 0 1\npoints: 4\n0 0\n0.2 nan\n0.5 0\n1 0\n");
  write("other.txt", "range: 0 1\npoints: 4\n0 0\n0.2 0\n0.5 0\n1 0\n");
  write("good.func", "range: 0 1\npoints: 4\n0 0\n0.2 0\n0.5 0\n1 5\n");
  const auto message = [&](const std::string& function) {
    return message_of("axiom: A\nfunction f = " + function + "\n", folder_);
  };
  EXPECT_THAT(message("\"new.func\""),
              HasSubstr("test.lsys:2:14: new.func:1: got 'fver 9 1', expected 'fver 1 1'"));
  EXPECT_THAT(message("\"nan.func\""),
              HasSubstr("test.lsys:2:14: nan.func:4: got '0.2 nan', expected a point"));
  EXPECT_THAT(message("\"other.txt\""),
              HasSubstr("got file \"other.txt\", expected one that ends with .func"));
  EXPECT_THAT(message("\"../x.func\""), HasSubstr("test.lsys:2:14: got file \"../x.func\""));
  EXPECT_THAT(message("\"none.func\""), HasSubstr("none.func"));
  EXPECT_THAT(message("\"good.func\" in 0 .. 1"),
              HasSubstr("test.lsys:2:14: good.func: got values from 0 to 5, expected them in 0 .. 1"));
  EXPECT_EQ(message("\"good.func\" in 0 .. 6"), "no error");
}

struct Fault {
  const char* function;
  const char* expected;
};
class BadFunctions : public testing::TestWithParam<Fault> {};

TEST_P(BadFunctions, AreRefusedWithTheirPlace) {
  EXPECT_THAT(message_of(fmt::format("{}\naxiom: A\n", GetParam().function)), HasSubstr(GetParam().expected));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadFunctions,
    testing::Values(
        Fault{"function f = [0, 1]", "test.lsys:1:14: got 2 numbers, expected 1, 4, 5 or 7 of a function"},
        Fault{"function f = [0, 1, 2]", "got 3 numbers"},
        Fault{"function f = [1, 2, 3, 4, 5, 6]", "got 6 numbers"},
        Fault{"function f = [1, 2, 3, 4, 5, 6, 7, 8]", "got 8 numbers"},
        Fault{"function f = []", "test.lsys:1:15: got ']', expected a finite number"},
        Fault{"function f = [0, nan, 0, 0]", "test.lsys:1:18: got 'n', expected a finite number"},
        Fault{"function f = [0, 1e999, 0, 0]", "test.lsys:1:18: got '1', expected a finite number"},
        Fault{"function f = [0, 0, 0, 2] in 0 .. 1",
              "test.lsys:1:14: key 'f_4': got 2, expected a number 0..1"},
        Fault{"function f = [0, 0, 0, 0] in 1 .. 0", "lower one first"},
        Fault{"function f = [0, 0, 0, 0] on 1 .. 0", "test.lsys:1:27: got 'o', expected 'in'"},
        Fault{"function f = 3", "expected '[' and the numbers of a function"},
        Fault{"function f = [1]\nfunction f = [1]", "test.lsys:2:10: got 'f' a second time"},
        Fault{"param f_1 = 1 in 0 .. 2\nfunction f = [1] in 0 .. 2",
              "got 'f_1' a second time, as a number of 'f'"},
        Fault{"function f = [1]\nlet g(x) = f(x, 1)\nconst c = g(1)", "f: got 2 arguments, expected 1"},
        Fault{"function f = [1]\nconst c = 0/0\nconst d = f(c)",
              "test.lsys:2:11: '0/0' is no finite number"}));

TEST(Functions, OfTheFrondAreSeenInItsShape) {
  const auto model = make_model("frond");
  const ParameterTable& table = model->table();
  ParameterValues values = table.defaults();
  const auto widest = [&] {
    Plant plant;
    EXPECT_TRUE(model->generate(values, 1, {}, plant).grown);
    float x = 0, z = 0;
    for (std::size_t i = 0; i < plant.leaves.size(); ++i) {
      const float reach = std::fabs(plant.leaves.position_m[i].x) + plant.leaves.length_m[i];
      if (reach > x) x = reach, z = plant.leaves.position_m[i].z;
    }
    return z / bounds(plant).upper.z;
  };
  const float before = widest();
  const double low[] = {1, 0.6, 0.3, 0.1, 0};
  for (std::size_t i = 0; i < 5; ++i) values[table.index_of(fmt::format("leaflet_{}", i + 1))] = low[i];
  EXPECT_LT(widest(), before);
}

// The FernLeaf of vlab by its own function files, as its description says how they act; they are not ours to
// ship.
TEST_F(FunctionFiles, OfTheFernLeafMakeItsLeaf) {
  const fs::path files = fs::path(ESPALIER_SOURCE_DIR) / "../shared/reference/fernleaf";
  if (!fs::exists(files)) GTEST_SKIP() << "the function files of vlab's FernLeaf are not here: " << files;
  for (const auto& entry : fs::directory_iterator(files))
    if (entry.path().extension() == ".func")
      fs::copy_file(entry.path(), folder_ / entry.path().filename(), fs::copy_options::overwrite_existing);
  write("fern.lsys", R"(steps: 60
unit: 0.3
leaf_shape: 1
param size = 1 in 0.5 .. 1.5 "length of the leaf, in units"
param close = 0.3 in 0.2 .. 0.6 "distance of leaflets, as a factor"
function internode = "int_length.func" in 0 .. 0.3
function width = "int_width.func" in 0 .. 1.2
function bend = "curvature.func" in -1 .. 1
function leaflet = "leaf_length.func" in -0.2 .. 1
function leaflet_width = "leaf_width.func" in 0 .. 1
function angle_of = "brangle.func" in 0 .. 2
axiom: A(0)
productions:
  A(s) : s < size --> I(s/size)[N(s/size,1)][N(s/size,-1)]A(s + close*max(0.01, internode(s/size))*size^0.5)
interpretation:
  I(x) --> F(close*max(0.01, internode(x))*size^0.5, 0.03*width(x)*size)+(20*bend(x)*close*max(0.01, internode(x))/size)
  N(x,side) : leaflet(x) > 0 --> -(side*57.3*angle_of(x))~("leaf", 0.5*leaflet(x)*size^0.5, 0.2*leaflet(x)*leaflet_width(x))
)");
  const auto model = make_model((folder_ / "fern.lsys").string());
  const ParameterTable& table = model->table();
  EXPECT_EQ(table.rows.size(), 2u + 6 * 7 + 1);
  Plant plant;
  ASSERT_TRUE(model->generate(table.defaults(), 1, {}, plant).grown);
  EXPECT_GT(plant.leaves.size(), 20u);
  // Leaflets are longest in the middle, where leaf_length.func is, and point forwards more and more.
  const auto at = [&](double share) {
    return static_cast<std::size_t>(share * static_cast<double>(plant.leaves.size() - 1));
  };
  const auto longest = std::max_element(plant.leaves.length_m.begin(), plant.leaves.length_m.end());
  const float middle =
      plant.leaves.position_m[static_cast<std::size_t>(longest - plant.leaves.length_m.begin())].z;
  EXPECT_GT(middle, 0.3f * bounds(plant).upper.z);
  EXPECT_LT(middle, 0.75f * bounds(plant).upper.z);
  EXPECT_GT(plant.leaves.axis[at(0.95)].z, plant.leaves.axis[at(0.05)].z);
}

}  // namespace
}  // namespace espalier::lsystem
