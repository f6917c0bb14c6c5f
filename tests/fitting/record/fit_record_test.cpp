// Records survive the trip through TOML; what cannot be run is refused in one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include <espalier/core/error.h>
#include <espalier/fitting/record/fit_record.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

using testing::HasSubstr;

FitRecord full_record() {
  FitRecord record;
  record.views = {{"/pictures/a \"tree\".png", {}}, {"/b.png", {90, -12.5, Projection::perspective, 30}}};
  record.target.separation.method = SeparationMethod::luminance;
  record.target.separation.side = TreeSide::dark;
  record.target_hash = "0123456789abcdef";
  record.objective = "iou";
  record.fit_seeds = 3;
  record.optimizer = "random_search";
  record.budget = {1234, 0.1, 0.75};
  record.growth = {100, 1e5};
  record.seed = 18446744073709551615ull;
  record.start = "palm";
  record.search = {{"g_scale", "curve*"}, {{"curve_v[1]", -0.1}, {"levels", 3}}};
  record.kind = KindChoice::palm;
  record.train_to_target = true;
  record.budget.branch_rounds = 17;
  record.budget.finish_from = 9;
  record.stages = {true, false, true, true};
  record.height_m = 12.34;
  record.versions = {{"espalier", "0.1.0"}};
  return record;
}

RecordedRun through_file(const std::string& text) {
  const auto path = fresh_folder("record") / "run.toml";
  std::ofstream(path) << text;
  return read_record(path);
}

/// As people leave it who change a record on purpose.
std::string without_check(std::string text) {
  const std::size_t line = text.find("check = ");
  return text.erase(line, text.find('\n', line) + 1 - line);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string reading_error(const std::string& text) {
  try {
    through_file(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string checking_error(const std::function<void(FitRecord&)>& spoil) {
  FitRecord record = full_record();
  spoil(record);
  try {
    check_record(record);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(FitRecord, ReadsBackWhatItWrote) {
  const std::string text = record_to_toml(full_record(), FitOutcome{77, 5, 3, FitStop::time});
  const auto [record, outcome] = through_file(text);
  EXPECT_EQ(record_to_toml(record, outcome), text);
  EXPECT_EQ(record.seed, full_record().seed);
  EXPECT_EQ(record.search.fixed, full_record().search.fixed);
  EXPECT_EQ(record.views[1].view.projection, Projection::perspective);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->evaluations, 77);
  EXPECT_EQ(outcome->branch_rounds, 5);
  EXPECT_EQ(outcome->finish_from, 3);
  EXPECT_EQ(record.stages, full_record().stages);
}

RC_GTEST_PROP(FitRecord, NumbersKeepTheirBits, (double value)) {
  RC_PRE(std::isfinite(value));
  FitRecord record = full_record();
  record.search.fixed = {{"x", value}};
  RC_ASSERT(through_file(record_to_toml(record, {})).record.search.fixed.at("x") == value);
}

TEST(FitRecord, NamesFileAndKeyOfWhatIsMissingOrWrong) {
  const std::string text = record_to_toml(full_record(), {});
  EXPECT_THAT(
      reading_error(replaced(text, "fit_seeds = 3\n", "")),
      HasSubstr(
          "run.toml: fit_seeds: got nothing (written by espalier 0.1.0), expected a whole number 1..1000"));
  EXPECT_THAT(reading_error(replaced(text, "seconds = 0.1", "seconds = \"long\"")),
              HasSubstr("budget.seconds: got 'long', expected a number above 0 (s)"));
  EXPECT_THAT(reading_error(replaced(text, "format = 1", "format = 9")),
              HasSubstr("run.toml:2: format: got 9 (written by espalier 0.1.0), expected 1"));
  EXPECT_THAT(reading_error("nonsense"), HasSubstr("run.toml:1"));
}

TEST(FitRecord, OfEarlierVersionsHasNoBranchRounds) {
  const std::string text = record_to_toml(full_record(), {});
  std::string older =
      replaced(replaced(without_check(text), "branch_rounds = 17", ""), "train_to_target = true\n", "");
  older = replaced(replaced(older, "finish_from = 9", ""), "stages = \"search,branches,finish\"", "");
  const FitRecord record = through_file(older).record;
  EXPECT_EQ(record.budget.branch_rounds, 0);
  EXPECT_FALSE(record.train_to_target);
}

// As the first version of the program wrote it, which had no kinds, stages, refinement or spaces, and took
// all trees of a picture.
constexpr const char* kFirstRecord =
    R"(# Everything that repeats this run: espalier fit --repeat DIRECTORY --out OTHER
format = 1
model = "weber_penn"
objective = "0.5*truncated_distance+0.5*iou"
optimizer = "cma_es"
seed = 7
fit_seeds = 2

[[views]]
picture = "/pictures/fir.png"
azimuth_deg = 0.0
elevation_deg = 0.0
perspective = false
field_of_view_deg = 40.0

[target]
size_px = 128
separation = "auto"
tree_side = "dark"
speck_px = -1
fill_pinholes = false
hash = "317f07db14e6c043"  # of the masks that were fitted

[budget]  # 0: no limit
evaluations = 300
seconds = 0.0
target_fitness = 0.0
max_stems = 1500.0
max_leaves = 6000.0

[search]
start = "auto"
free = ["g_scale"]  # none: the default set of the model

[search.fixed]
"levels" = 2.0

[optimizer_settings]

[versions]
"espalier" = "0.1.0"

[outcome]
evaluations = 300
stopped_by = "evaluations"
)";

TEST(FitRecord, OfTheFirstVersionIsReadAsItWasMeant) {
  const auto [record, outcome] = through_file(kFirstRecord);
  EXPECT_EQ(record.seed, 7u);
  EXPECT_EQ(record.kind, KindChoice::any);
  EXPECT_FALSE(record.target.one_tree);
  EXPECT_EQ(record.target.separation.side, TreeSide::dark);
  EXPECT_EQ(record.budget.branch_rounds, 0);
  EXPECT_EQ(record.budget.finish_from, kLastShare);
  EXPECT_EQ(record.stages, FitStages{});
  EXPECT_EQ(record.growth.max_leaves, 6000);
  EXPECT_FALSE(record.height_m);
  EXPECT_EQ(record.search.fixed.at("levels"), 2);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->stopped_by, FitStop::evaluations);
}

// But for its first line, as version 0.1 wrote it after its last change.
constexpr const char* kWholeRecord = R"(# The record of a fit: everything that repeats it
format = 1
model = "weber_penn"
objective = "iou"
optimizer = "random_search"
seed = -1
fit_seeds = 3
kind = "palm"
train_to_target = true
height_m = 12.34

[[views]]
picture = "/pictures/a \"tree\".png"
azimuth_deg = 0.0
elevation_deg = 0.0
perspective = false
field_of_view_deg = 40.0

[[views]]
picture = "/b.png"
azimuth_deg = 90.0
elevation_deg = -12.5
perspective = true
field_of_view_deg = 30.0

[target]
size_px = 128
separation = "luminance"
tree_side = "dark"
speck_px = -1
fill_pinholes = false
one_tree = true  # of several, the largest; else all as one
labels = "auto"
hash = "0123456789abcdef"  # of the masks that were fitted

[budget]  # 0: no limit
evaluations = 1234
seconds = 0.1
target_fitness = 0.75
branch_rounds = 17  # after the search; -1: as many as time allows
finish_from = 9  # round; -1: for the last 40 %
max_stems = 100.0
max_leaves = 100000.0

[search]
stages = "search,branches,finish"
start = "palm"
species = ""
space = "species:2"  # searched first
space_evaluations = 300
bare_wood_price = 0.2
depth_price = 0.2
any_leaf_size = false
freedom = -1.0  # of single branches; -1: as the kind of tree needs
free = ["g_scale", "curve*"]  # none: the default set of the model

[search.fixed]
"curve_v[1]" = -0.1
"levels" = 3.0

[optimizer_settings]

[versions]
"espalier" = "0.1.0"

[outcome]
evaluations = 77
branch_rounds = 5
finish_from = 3
stopped_by = "time"
)";

TEST(FitRecord, IsWrittenAsEver) {
  FitRecord record = full_record();
  record.space = "species:2";
  EXPECT_EQ(without_check(record_to_toml(record, FitOutcome{77, 5, 3, FitStop::time})), kWholeRecord);
}

TEST(FitRecord, RefusesRoundsWithoutEndAndUnknownKinds) {
  const std::string text = record_to_toml(full_record(), {});
  EXPECT_THAT(reading_error(replaced(text, "kind = \"palm\"", "kind = \"bush\"")),
              HasSubstr("got 'bush', expected auto"));
  EXPECT_THAT(checking_error([](FitRecord& r) {
                r.budget = {100, 0, 0, kWhileTimeLasts};
              }),
              HasSubstr("budget.branch_rounds: got rounds without an end"));
  EXPECT_THAT(checking_error([](FitRecord& r) { r.budget.branch_rounds = -2; }),
              HasSubstr("budget.branch_rounds: got -2, expected a whole number from 0, or 'time'"));
}

TEST(FitRecord, AcceptsAWholeRecord) {
  EXPECT_EQ(checking_error([](FitRecord&) {}), "no error");
}

TEST(FitRecord, NamesTheClosestOptimizer) {
  EXPECT_THAT(checking_error([](FitRecord& r) { r.optimizer = "cma"; }), HasSubstr("cma_es"));
}

TEST(FitRecord, RefusesWhatCannotRun) {
  EXPECT_THAT(checking_error([](FitRecord& r) { r.views.clear(); }), HasSubstr("views: got no picture"));
  EXPECT_THAT(checking_error([](FitRecord& r) { r.budget = {0, 0, 0}; }), HasSubstr("no budget"));
  EXPECT_THAT(checking_error([](FitRecord& r) { r.budget.seconds = -1; }), HasSubstr("budget.seconds"));
  EXPECT_THAT(checking_error([](FitRecord& r) { r.budget.seconds = NAN; }), HasSubstr("budget.seconds"));
  EXPECT_THAT(checking_error([](FitRecord& r) { r.budget.target_fitness = 2; }), HasSubstr("target_fitness"));
  EXPECT_THAT(checking_error([](FitRecord& r) { r.fit_seeds = 0; }), HasSubstr("fit_seeds: got 0"));
  EXPECT_THAT(checking_error([](FitRecord& r) { r.height_m = 0; }), HasSubstr("height_m: got 0"));
  EXPECT_THAT(checking_error([](FitRecord& r) { r.target.size_px = 8; }), HasSubstr("target.size_px: got 8"));
  EXPECT_THAT(checking_error([](FitRecord& r) { r.growth.max_stems = 0; }),
              HasSubstr("growth.max_stems: got 0"));
  EXPECT_THAT(checking_error([](FitRecord& r) { r.optimizer_settings["nope"] = 1; }), HasSubstr("nope"));
  EXPECT_THAT(checking_error([](FitRecord& r) { r.objective = "iuo"; }), HasSubstr("iou"));
}

TEST(ParseView, ReadsFileAzimuthElevationAndFieldOfView) {
  EXPECT_EQ(parse_view("a.png").picture, "a.png");
  const ViewRecord side = parse_view("C:odd name.png:90,-5");
  EXPECT_EQ(side.picture, "C:odd name.png");
  EXPECT_EQ(side.view.azimuth_deg, 90);
  EXPECT_EQ(side.view.elevation_deg, -5);
  EXPECT_EQ(side.view.projection, Projection::orthographic);
  EXPECT_EQ(parse_view("a.png:0,0,50").view.field_of_view_deg, 50);
}

TEST(ParseView, RefusesAnglesThatAreNone) {
  for (const char* bad : {"a.png:", "a.png:90", "a.png:x,y", "a.png:0,0,0", "a.png:nan,0", "a.png:0,91",
                          ":1,2", "a.png:1,2,3,4"})
    EXPECT_THROW(parse_view(bad), InputError) << bad;
}

}  // namespace
}  // namespace espalier
