// Laws of presets: the bundled ones hold the published values, extending, writing and reading back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <espalier/core/error.h>
#include <espalier/models/grow_preset.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

/// A folder with preset files that goes with its test.
struct PresetFolder {
  fs::path path = fresh_folder("presets");
  ~PresetFolder() { fs::remove_all(path); }

  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path / name, std::ios::binary) << content;
    return (path / name).string();
  }
};

double value_of(const Preset& preset, const std::string& name) {
  return preset.values[model_by_name(preset.model).table().index_of(name)];
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

/// A value that the row accepts, with all 53 bits of a double where it need not be whole.
rc::Gen<double> valid_value(const ParameterInfo& row) {
  const bool whole = row.scale == Scale::choice || (row.scale == Scale::integer && !row.relaxable);
  return rc::gen::map(rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 53), [row, whole](auto draw) {
    const double value = row.lower + (row.upper - row.lower) * static_cast<double>(draw) * 0x1p-53;
    return (whole ? std::round(value) : value) + 0.0;
  });
}

TEST(Preset, BundledOnesHoldTheReferenceValues) {
  std::ifstream csv(fs::path(ESPALIER_SOURCE_DIR) / "tests/models/reference_species.csv");
  ASSERT_TRUE(csv);
  std::string line;
  std::getline(csv, line);
  const std::vector<std::string> species = split(line);
  std::map<std::string, Preset> presets;
  for (std::size_t i = 1; i < species.size(); ++i) presets[species[i]] = load_preset(species[i]);
  EXPECT_EQ(presets.size(), 19u);
  int rows = 0;
  for (; std::getline(csv, line); ++rows) {
    const std::vector<std::string> cells = split(line);
    ASSERT_EQ(cells.size(), species.size()) << line;
    for (std::size_t i = 1; i < cells.size(); ++i)
      EXPECT_EQ(value_of(presets[species[i]], cells[0]), std::stod(cells[i]))
          << species[i] << " " << cells[0];
  }
  EXPECT_EQ(rows, 100);
}

TEST(Preset, BundledOnesAreSortedAndDescribed) {
  const std::vector<std::string> names = bundled_presets();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_THAT(names, testing::SizeIs(19));
  for (const std::string& name : names) {
    EXPECT_EQ(load_preset(name).name, name);
    EXPECT_NE(load_preset(name).description, "");
  }
}

TEST(Preset, BundledOnesAreTheFilesInTheSources) {
  const fs::path folder = fs::path(ESPALIER_SOURCE_DIR) / "src/weber_penn/species";
  for (const std::string& name : bundled_presets())
    EXPECT_EQ(load_preset(name).values, load_preset((folder / (name + ".toml")).string()).values) << name;
}

TEST(Preset, WritingAndReadingKeepsEveryBit) {
  const PresetFolder folder;
  const ParameterTable& table = model_by_name("weber_penn").table();
  EXPECT_TRUE(rc::check([&] {
    Preset preset{"a \"name\"", "tab\t, back\\slash, line\nfeed, ü", "weber_penn", {}};
    for (const ParameterInfo& row : table.rows) preset.values.push_back(*valid_value(row));
    for (const CurveInfo& curve : table.curves)  // a density of 0 everywhere is refused
      if (curve.role == CurveRole::density)
        preset.values[curve.first_row] += preset.values[curve.first_row] == 0;
    preset.demonstration = *rc::gen::arbitrary<bool>();
    if (*rc::gen::arbitrary<bool>()) preset.seed = *rc::gen::element<Seed>(0, 7, Seed{1} << 63, ~Seed{0});
    for (PartColor* color : {&preset.colors.bark, &preset.colors.leaf, &preset.colors.autumn})
      if (*rc::gen::arbitrary<bool>())
        *color = {*rc::gen::arbitrary<std::uint8_t>(), *rc::gen::arbitrary<std::uint8_t>(), 7, true};
    const Preset again = load_preset(folder.write("random.toml", preset_to_toml(preset)));
    RC_ASSERT(again.name == preset.name);
    RC_ASSERT(again.seed == preset.seed);
    RC_ASSERT(again.colors == preset.colors);
    RC_ASSERT(again.demonstration == preset.demonstration);
    RC_ASSERT(again.description == preset.description);
    for (std::size_t i = 0; i < preset.values.size(); ++i)
      RC_ASSERT(std::bit_cast<std::uint64_t>(again.values[i]) ==
                std::bit_cast<std::uint64_t>(preset.values[i]));
  }));
}

TEST(Preset, EverySpeciesHasItsColours) {
  for (const std::string& name : bundled_presets()) {
    const Preset preset = load_preset(name);
    EXPECT_EQ(preset.colors.bark.is_set && preset.colors.leaf.is_set && preset.colors.autumn.is_set,
              !preset.demonstration)
        << name;
  }
  const PartColor birch = load_preset("silver_birch").colors.bark, bamboo = load_preset("bamboo").colors.bark,
                  larch = load_preset("european_larch").colors.autumn;
  EXPECT_GT(std::min({birch.r, birch.g, birch.b}), 200) << "white";
  EXPECT_GT(bamboo.g, bamboo.r) << "green";
  EXPECT_GT(std::min(larch.r, larch.g), 3 * larch.b) << "yellow";
}

TEST(Preset, ColoursAreInherited) {
  const PresetFolder folder;
  const Preset preset =
      load_preset(folder.write("mine.toml", "extends = \"silver_birch\"\nleaf_color = \"#010203\"\n"));
  EXPECT_EQ(preset.colors.bark, load_preset("silver_birch").colors.bark);
  EXPECT_EQ(preset.colors.leaf, (PartColor{1, 2, 3, true}));
}

/// What a preset of one line says is wrong with it.
std::string error_of_line(const std::string& line) {
  const PresetFolder folder;
  try {
    load_preset(folder.write("curve.toml", "model = \"weber_penn\"\n" + line + "\n"));
  } catch (const InputError& error) {
    const std::string text = error.what();
    return text.substr(text.find("curve.toml"));
  }
  return "no error";
}

TEST(PresetCurves, AreReadFromOneFourFiveOrSevenNumbers) {
  const PresetFolder folder;
  const auto values_of = [&](const std::string& numbers) {
    const std::string line = fmt::format("\"length_along[1]\" = {}\n", numbers);
    return load_preset(folder.write("curve.toml", "model = \"weber_penn\"\n" + line)).values;
  };
  const ParameterTable& table = model_by_name("weber_penn").table();
  const auto numbers_in = [&](const ParameterValues& values) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(table.index_of("length_along[1].1"));
    return std::vector<double>(first, first + 7);
  };
  EXPECT_THAT(numbers_in(values_of("1.5")), testing::Each(1.5));
  EXPECT_THAT(numbers_in(values_of("[2]")), testing::Each(2));
  EXPECT_THAT(numbers_in(values_of("[0, 1, 2, 3]")), testing::ElementsAre(0, 0.25, 0.75, 1.5, 2.25, 2.75, 3));
  EXPECT_THAT(numbers_in(values_of("[1, 2, 3, 4, 5, 6, 7]")), testing::ElementsAre(1, 2, 3, 4, 5, 6, 7));
  ParameterValues rest = values_of("[0, 1, 2, 3]");
  for (int point = 1; point <= 7; ++point) rest[table.index_of(fmt::format("length_along[1].{}", point))] = 1;
  EXPECT_EQ(rest, table.defaults());
}

TEST(PresetCurves, AreWrittenWhereTheyChangeSomething) {
  const ParameterTable& table = model_by_name("weber_penn").table();
  Preset preset{"a", "", "weber_penn", table.defaults()};
  EXPECT_THAT(preset_to_toml(preset), Not(HasSubstr("_along")));
  for (int point = 1; point <= 7; ++point)
    preset.values[table.index_of(fmt::format("radius_along[2].{}", point))] = 1.5;
  EXPECT_THAT(preset_to_toml(preset), HasSubstr("\n\"radius_along[2]\" = [1.5] "));
  preset.values[table.index_of("radius_along[2].4")] = 0.25;
  EXPECT_THAT(preset_to_toml(preset),
              HasSubstr("\n\"radius_along[2]\" = [1.5, 1.5, 1.5, 0.25, 1.5, 1.5, 1.5] "));
}

TEST(PresetCurves, BadOnesAreRefused) {
  const std::map<std::string, std::string> errors{
      {"\"length_along[1]\" = [1, 2]",
       "curve.toml:2: key 'length_along[1]': got 2 numbers, expected 1, 4, 5 or 7 of a function"},
      {"\"length_along[1]\" = [1, 2, 3]",
       "curve.toml:2: key 'length_along[1]': got 3 numbers, expected 1, 4, 5 or 7 of a function"},
      {"\"length_along[1]\" = [1, 2, 3, 4, 5, 6]",
       "curve.toml:2: key 'length_along[1]': got 6 numbers, expected 1, 4, 5 or 7 of a function"},
      {"\"length_along[1]\" = nan", "curve.toml:2: key 'length_along[1]': got nan, expected a number 0..10"},
      {"\"length_along[1]\" = [1, nan, 1, 1]",
       "curve.toml:2: key 'length_along[1]': got nan, expected a number 0..10"},
      {"\"radius_along[0]\" = [1, 1, -0.1, 1]",
       "curve.toml:2: key 'radius_along[0]': got -0.1, expected a number 0..10"},
      {"\"density_along[2]\" = [0, -1, 0, 0]",
       "curve.toml:2: key 'density_along[2]': got -1, expected a number 0..20"},
      {"leaf_density_along = [0, 0, 0, 0]",
       "curve.toml:2: key 'leaf_density_along': got a density of 0 everywhere, expected a number above 0"},
      {"leaf_scale_along = [1, \"two\", 1, 1]",
       "curve.toml:2: key 'leaf_scale_along': got 'two', expected a number 0..10"},
      {"length_along = [1, 1, 1, 1]",
       "curve.toml:2: key 'length_along': got an unknown key, expected one like 'length_along[1]'"},
      {"\"density_along[0]\" = 1",
       "curve.toml:2: key 'density_along[0]': got an unknown key, expected one like 'density_along[1]'"},
  };
  for (const auto& [line, error] : errors) EXPECT_EQ(error_of_line(line), error);
}

TEST(Preset, OfPartsThatATreeLacksOnlyWhatIsNotTheDefaultIsWritten) {
  Preset preset = load_preset("quaking_aspen");
  const ParameterTable& table = model_by_name(preset.model).table();
  EXPECT_THAT(preset_to_toml(preset), Not(HasSubstr("crown_")));
  preset.values[table.index_of("crown_top_x")] = 0.25;
  EXPECT_THAT(preset_to_toml(preset), AllOf(HasSubstr("crown_top_x = 0.25"), Not(HasSubstr("crown_use")),
                                            Not(HasSubstr("crown_top ="))));
  preset.values[table.index_of("crown_use")] = 3;
  EXPECT_THAT(preset_to_toml(preset), AllOf(HasSubstr("crown_use = \"train\""), HasSubstr("crown_top = 1 ")));
}

TEST(Preset, RowsThatSayNothingAtTheirDefaultAreWrittenElsewhere) {
  Preset preset = load_preset("quaking_aspen");
  EXPECT_THAT(preset_to_toml(preset), Not(HasSubstr("least_radius")));
  preset.values[model_by_name(preset.model).table().index_of("least_radius")] = 2;
  EXPECT_THAT(preset_to_toml(preset), HasSubstr("least_radius = 2 "));
}

TEST(Preset, GrowsWithItsSeedUnlessAnotherIsAskedFor) {
  Preset preset = load_preset("apple");
  const auto knots = [&](const PresetGrowth& growth) {
    return grow_preset(preset, "apple", growth).knots.radius_m;
  };
  const auto of_species = knots({}), of_seven = knots({.seed = 7});
  EXPECT_NE(of_species, of_seven);
  EXPECT_EQ(of_species, knots({.seed = 1}));
  preset.seed = 7;
  EXPECT_EQ(of_seven, knots({}));
  EXPECT_EQ(of_species, knots({.seed = 1}));
}

TEST(Preset, ASeedThatIsNoneIsRefused) {
  const PresetFolder folder;
  for (const char* seed : {"1.5", "\"one\"", "true"}) {
    const std::string text = fmt::format("model = \"weber_penn\"\nseed = {}\n", seed);
    try {
      load_preset(folder.write("seed.toml", text));
      FAIL() << seed;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("seed.toml:2: key 'seed': got "));
    }
  }
}

TEST(Preset, OfTheBundledOnesTheSphereTreeAloneIsNoSpecies) {
  for (const std::string& name : bundled_presets())
    EXPECT_EQ(load_preset(name).demonstration, name == "sphere_tree") << name;
}

TEST(Preset, WhatExtendsADemonstrationMayBeASpecies) {
  const PresetFolder folder;
  const std::string mine = folder.write("mine.toml", "extends = \"sphere_tree\"\n");
  EXPECT_FALSE(load_preset(mine).demonstration);
  EXPECT_EQ(load_preset(mine).values, load_preset("sphere_tree").values);
}

TEST(Preset, ADemonstrationThatIsNeitherTrueNorFalseIsRefused) {
  const PresetFolder folder;
  for (const char* value : {"1", "\"true\"", "[true]"}) {
    const std::string text = fmt::format("model = \"weber_penn\"\ndemonstration = {}\n", value);
    try {
      load_preset(folder.write("wrong.toml", text));
      FAIL() << value;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("wrong.toml:2: key 'demonstration': got "));
      EXPECT_THAT(error.what(), HasSubstr("expected true or false"));
    }
  }
}

TEST(Preset, WhatItDoesNotNameIsTheModelsDefault) {
  const PresetFolder folder;
  const Preset preset = load_preset(folder.write("bare.toml", "model = \"weber_penn\"\n"));
  EXPECT_EQ(preset.values, model_by_name("weber_penn").table().defaults());
  EXPECT_EQ(preset.name, "bare");
}

TEST(Preset, ExtendingChangesOnlyWhatItNames) {
  const PresetFolder folder;
  const Preset base = load_preset("weeping_willow");
  const Preset mine = load_preset(
      folder.write("mine.toml", "extends = \"weeping_willow\"\ng_scale = 20\ncurve_v = [1, 2]\n"));
  const ParameterTable& table = model_by_name("weber_penn").table();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::string name = table.rows[i].full_name();
    const std::map<std::string, double> changed = {{"g_scale", 20}, {"curve_v[0]", 1}, {"curve_v[1]", 2}};
    EXPECT_EQ(mine.values[i], changed.contains(name) ? changed.at(name) : base.values[i]) << name;
  }
}

TEST(Preset, ExtendingFollowsPathsFromTheFileItself) {
  const PresetFolder folder;
  fs::create_directory(folder.path / "below");
  folder.write("base.toml", "extends = \"acer\"\nflare = 0.125\n");
  const std::string mine = folder.write("below/mine.toml", "extends = \"../base.toml\"\nratio = 0.25\n");
  EXPECT_EQ(value_of(load_preset(mine), "flare"), 0.125);
  EXPECT_EQ(value_of(load_preset(mine), "ratio"), 0.25);
}

TEST(Preset, AFileMayExtendTheBundledPresetOfItsOwnName) {
  const PresetFolder folder;
  const std::string mine = folder.write("acer.toml", "extends = \"acer\"\nflare = 0.125\n");
  EXPECT_EQ(value_of(load_preset(mine), "flare"), 0.125);
}

TEST(Preset, OneLevelAloneMayBeSet) {
  const PresetFolder folder;
  const std::string mine = folder.write("mine.toml", "extends = \"acer\"\n\"length[2]\" = 0.75\n");
  EXPECT_EQ(value_of(load_preset(mine), "length[2]"), 0.75);
  EXPECT_EQ(value_of(load_preset(mine), "length[1]"), value_of(load_preset("acer"), "length[1]"));
}

TEST(Preset, ChoicesAreNamesOrNumbers) {
  const PresetFolder folder;
  const std::string named =
      folder.write("named.toml", "model = \"weber_penn\"\nshape = \"flame\"\nblossom_shape = \"magnolia\"\n");
  const std::string numbered =
      folder.write("numbered.toml", "model = \"weber_penn\"\nshape = 5\nblossom_shape = 3\n");
  EXPECT_EQ(load_preset(named).values, load_preset(numbered).values);
  EXPECT_EQ(value_of(load_preset(named), "shape"), 5);
}

TEST(Preset, TropismIsAVectorOrThreeNumbers) {
  const PresetFolder folder;
  const std::string vector = folder.write("vector.toml", "model = \"weber_penn\"\ntropism = [1, 2, 3]\n");
  const std::string numbers =
      folder.write("numbers.toml", "model = \"weber_penn\"\ntropism_x = 1\ntropism_y = 2\ntropism_z = 3\n");
  EXPECT_EQ(load_preset(vector).values, load_preset(numbers).values);
}

TEST(Preset, NegativeZeroIsZero) {
  const PresetFolder folder;
  const Preset preset = load_preset(folder.write("zero.toml", "model = \"weber_penn\"\nflare = -0.0\n"));
  EXPECT_FALSE(std::signbit(value_of(preset, "flare")));
}

TEST(Preset, ACycleIsAnErrorThatNamesTheKey) {
  const PresetFolder folder;
  folder.write("a.toml", "extends = \"b.toml\"\n");
  const std::string b = folder.write("b.toml", "extends = \"a.toml\"\n");
  try {
    load_preset(b);
    FAIL() << "expected InputError";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.toml:1: key 'extends': got 'b.toml'"));
    EXPECT_THAT(error.what(), HasSubstr("expected no cycle"));
  }
}

/// One fault in the file, and what its message must say.
struct Fault {
  const char* law;
  std::string line;
  std::string message;
};

class PresetFault : public testing::TestWithParam<Fault> {};

TEST_P(PresetFault, IsOneLineWithPlaceGotAndExpected) {
  const PresetFolder folder;
  const std::string file = folder.write("bad.toml", "model = \"weber_penn\"\n" + GetParam().line + "\n");
  try {
    load_preset(file);
    FAIL() << "expected InputError";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith(file + ":2: " + GetParam().message));
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
  }
}

INSTANTIATE_TEST_SUITE_P(
    One, PresetFault,
    testing::Values(
        Fault{"UnknownKey", "g_scal = 1", "key 'g_scal': got an unknown key, expected one like 'g_scale'"},
        Fault{"ColourByName", "bark_color = \"white\"",
              "key 'bark_color': got 'white', expected a colour such as \"#ece9e2\""},
        Fault{"ColourOfThreeDigits", "leaf_color = \"#fff\"",
              "key 'leaf_color': got '#fff', expected a colour"},
        Fault{"ColourThatIsANumber", "autumn_color = 3", "key 'autumn_color': got 3, expected a string"},
        Fault{"NaN", "flare = nan", "key 'flare': got nan, expected a number 0..20"},
        Fault{"Infinity", "flare = inf", "key 'flare': got inf, expected a number"},
        Fault{"NegativeInfinity", "flare = -inf", "key 'flare': got -inf, expected a number"},
        Fault{"VeryLarge", "g_scale = 1e308", "key 'g_scale': got 1e+308, expected a number"},
        Fault{"BeyondDoubles", "g_scale = 1e999", "got bad TOML"},
        Fault{"TooManyLevels", "levels = 9", "key 'levels': got 9, expected a whole number 1..4"},
        Fault{"TooManyBranches", "branches = [1, 1e9]",
              "key 'branches[1]': got 1000000000, expected a number"},
        Fault{"FractionOfAWholeNumber", "curve_res = [5, 2.5]",
              "key 'curve_res[1]': got 2.5, expected a whole number 0..100"},
        Fault{"TextForANumber", "flare = \"wide\"", "key 'flare': got 'wide', expected a number 0..20"},
        Fault{"TruthForANumber", "flare = true", "key 'flare': got true, expected a number"},
        Fault{"DateForANumber", "flare = 2020-01-01", "key 'flare': got a date or time, expected a number"},
        Fault{"ArrayForANumber", "flare = [1]", "key 'flare': got an array of 1, expected a number"},
        Fault{"TableForANumber", "flare = {a = 1}", "key 'flare': got a table, expected a number"},
        Fault{"NumberForAnArray", "length = 1", "key 'length': got 1, expected an array of at most 4 values"},
        Fault{"TooLongAnArray", "length = [1, 1, 1, 1, 1]",
              "key 'length': got an array of 5, expected an array of at most 4 values"},
        Fault{"TextInAnArray", "length = [1, \"long\"]", "key 'length[1]': got 'long', expected a number"},
        Fault{"UnknownChoice", "shape = \"cubic\"", "key 'shape': got 'cubic', expected one of conical, "},
        Fault{"ChoiceOutOfRange", "shape = 9", "key 'shape': got 9, expected one of conical, "},
        Fault{"NumberForADescription", "description = 1", "key 'description': got 1, expected a string"},
        Fault{"DuplicateKey", "model = \"weber_penn\"", "got bad TOML"},
        Fault{"BadSyntax", "flare = = 1", "got bad TOML"},
        Fault{"CrownWithoutARadius", "crown_radius_left = 0",
              "key 'crown_radius_left': got 0, expected a number"},
        Fault{"CrownWhoseBottomIsItsTop", "crown_bottom = 1", "key 'crown_bottom': got 1, expected a number"},
        Fault{"UnknownUseOfACrown", "crown_use = \"prune\"",
              "key 'crown_use': got 'prune', expected one of off, cut, length, train"},
        Fault{"ExtendsNothing", "extends = \"acre\"",
              "key 'extends': got preset 'acre', expected a path or a bundled preset, the closest is 'acer'"},
        Fault{"BranchDeeperThanTheTree", "branch = [{ path = \"0/1/2/3/4\", length = 1.0 }]",
              "path: got '0/1/2/3/4' of 5 levels, expected at most"},
        Fault{"BranchOnATrunkThatIsNotThere", "branch = [{ path = \"3/1\", length = 1.0 }]",
              "path: got '3/1' on trunk 3, expected a trunk below 1"},
        Fault{"ExtendsAMissingFile", "extends = \"no.toml\"", "key 'extends': "}),
    [](const auto& info) { return info.param.law; });

class LsystemPresetFault : public testing::TestWithParam<Fault> {};

TEST_P(LsystemPresetFault, IsOneLineWithPlaceGotAndExpected) {
  const PresetFolder folder;
  const std::string file = folder.write("bad.toml", "model = \"acer.lsys\"\n" + GetParam().line + "\n");
  try {
    load_preset(file);
    FAIL() << "expected InputError";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith(file + ":" + GetParam().message));
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
  }
}

INSTANTIATE_TEST_SUITE_P(
    One, LsystemPresetFault,
    testing::Values(
        Fault{"Seed", "[[branch]]\npath = \"0/1\"\nseed = 7",
              "2: seed: got one for branch 0/1, expected none: model 'acer.lsys' cannot change it"},
        Fault{"SharedSeed",
              "[[branch]]\npath = \"0/1\"\nlength = 1.0\n[[branch]]\npath = \"0/2\"\n"
              "shares = \"x\"\n[shared.x]\nshares = \"y\"\n[shared.y]\nseed = 7",
              "5: seed: got one for branch 0/2, expected none"},
        Fault{"CrownOfABranch", "[[branch]]\npath = \"0/1\"\ncrown = { radius = 0.4 }",
              "2: crown: got one for branch 0/1, expected none: model 'acer.lsys' has no crowns of branches"},
        Fault{"AParameterOfABranch", "[[branch]]\npath = \"0/1\"\nunit = 2",
              "4: key 'unit': got one for a branch, expected none: a plant of acer.lsys has it as a whole"},
        Fault{"GrowingIntoAPicture",
              "[[grown_into]]\noutline = \"a.png\"\nmetres_per_px = 1\nbase_row_px = 1",
              " key 'grown_into': got outlines to grow into, expected none: model 'acer.lsys'"}),
    [](const auto& info) { return info.param.law; });

TEST(Preset, AnLsystemsBranchesMayBeOverridden) {
  const PresetFolder folder;
  const std::string base = folder.write("base.toml",
                                        "model = \"acer.lsys\"\n[[branch]]\npath = \"0/1\"\nlength = 1.5\n"
                                        "[[branch]]\npath = \"0/2\"\nseed = 0\n");
  const std::string file =
      folder.write("next.toml", "extends = \"base.toml\"\n[[branch]]\npath = \"0/1\"\nremoved = true\n");
  const Preset preset = load_preset(file);
  EXPECT_EQ(preset.model, "acer.lsys");
  EXPECT_EQ(preset.overrides.find({0, 1})->set.overrides.size(), 2u);
}

std::string loading_error(const std::string& name_or_path) {
  try {
    load_preset(name_or_path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Preset, AnUnknownNameIsAnsweredWithTheClosest) {
  EXPECT_EQ(loading_error("quaking_aspn"),
            "got preset 'quaking_aspn', expected a path or a bundled preset, the closest is 'quaking_aspen'");
}

TEST(Preset, AnUnknownModelListsTheKnownOnes) {
  const PresetFolder folder;
  const std::string file = folder.write("bad.toml", "model = \"oak\"\n");
  EXPECT_THAT(loading_error(file),
              testing::StartsWith(
                  file + ":1: key 'model': got model 'oak', expected an .lsys file or one of: weber_penn"));
}

TEST(Preset, AModelOtherThanTheExtendedOneIsRefused) {
  const PresetFolder folder;
  const std::string file = folder.write("bad.toml", "extends = \"acer\"\nmodel = \"oak\"\n");
  EXPECT_EQ(loading_error(file), file + ":2: key 'model': got 'oak', expected 'weber_penn' as in 'acer'");
}

TEST(Preset, NoModelAtAllIsRefused) {
  const PresetFolder folder;
  EXPECT_THAT(loading_error(folder.write("bad.toml", "flare = 1\n")),
              HasSubstr("got no key 'model' or 'extends', expected model = \"weber_penn\""));
}

TEST(Preset, TheFaultOfAnExtendedFileIsNamedThere) {
  const PresetFolder folder;
  const std::string base = folder.write("base.toml", "model = \"weber_penn\"\n\nflare = -1\n");
  EXPECT_THAT(loading_error(folder.write("mine.toml", "extends = \"base.toml\"\n")),
              testing::StartsWith(base + ":3: key 'flare': got -1"));
}

TEST(Preset, NamesItsLSystemFromItsOwnFolderOnFirst) {
  const PresetFolder folder;
  const std::string file =
      folder.write("twig.lsys", "param reach = 2 in 1 .. 3 \"of it\"\naxiom: F(reach)\n");
  const std::string preset = folder.write("short.toml", "model = \"twig.lsys\"\nreach = 1.5\n");
  EXPECT_TRUE(is_same_model(load_preset(preset).model, file));
  EXPECT_EQ(load_preset(folder.write("fir.toml", "model = \"small_pine.lsys\"\n")).model, "small_pine.lsys");
}

TEST(Models, TwoPathsOfOneFileAreOneModel) {
  const PresetFolder folder;
  const std::string file = folder.write("twig.lsys", "axiom: F\n"),
                    other = folder.write("log.lsys", "axiom: F\n");
  EXPECT_TRUE(is_same_model(file, (folder.path / "." / "twig.lsys").string()));
  EXPECT_FALSE(is_same_model(file, other));
  EXPECT_FALSE(is_same_model("weber_penn", file));
}

TEST(Preset, ExtendsAChainOfBoundedLength) {
  constexpr int kLongest = 64;
  const PresetFolder folder;
  folder.write("0.toml", "extends = \"acer\"\nflare = 0.125\n");
  const auto name = [](int i) { return std::to_string(i) + ".toml"; };
  std::string last;
  for (int i = 1; i < kLongest; ++i) last = folder.write(name(i), "extends = \"" + name(i - 1) + "\"\n");
  EXPECT_NO_THROW(load_preset(last));
  const std::string too_long = folder.write(name(kLongest), "extends = \"" + name(kLongest - 1) + "\"\n");
  EXPECT_THAT(loading_error(too_long), HasSubstr("got a chain of more than 64 presets, expected fewer"));
}

}  // namespace
}  // namespace espalier
