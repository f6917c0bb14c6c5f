// Experiments as people write them: what is read, and one clear line with file and line for what is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include <espalier/core/error.h>
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/run_experiment.h>

#include "support/option_samples.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

fs::path file_with(const std::string& text) {
  const fs::path path = fresh_folder("experiment") / "study.toml";
  std::ofstream(path) << text;
  return path;
}

std::string error_of(const std::string& text) {
  try {
    read_experiment(file_with(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

const std::string kFits = "[fits]\ntargets = ['oc_palm']\nevaluations = 10\n";

TEST(ReadExperiment, EveryShippedExperimentReads) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(ESPALIER_SOURCE_DIR "/experiments")) {
    if (entry.path().extension() != ".toml" || entry.path().stem().extension() == ".expected") continue;
    EXPECT_NO_THROW(read_experiment(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 5);
}

TEST(ReadExperiment, ListsMultiply) {
  const Experiment experiment = read_experiment(file_with(
      "[fits]\ntargets = ['oc_palm', 'fir']\noptimizers = ['cma_es', 'ga', {name = 'ga', population = 8}]\n"
      "objectives = ['iou', 'dice']\nspaces = ['default', {label = 'few', free = ['g_scale']}]\n"
      "starts = ['palm', 'auto']\nseeds = [4, 9, 2]\nevaluations = 10\n"));
  const Plan plan = plan_of(experiment, fresh_folder("plan"));
  EXPECT_EQ(plan.runs.size(), 2u * 3 * 2 * 2 * 2 * 3);
  std::set<std::string> names;
  for (const PlannedRun& run : plan.runs) names.insert(run.name);
  EXPECT_EQ(names.size(), plan.runs.size()) << "one directory a run";
}

TEST(ReadExperiment, AWholeNumberOfSeedsCountsFromOne) {
  EXPECT_EQ(read_experiment(file_with(kFits + "seeds = 3\n")).fits->seeds, (std::vector<Seed>{1, 2, 3}));
}

TEST(ReadExperiment, NamesFileLineAndWhatIsWrong) {
  EXPECT_THAT(error_of(kFits + "optimisers = ['ga']\n"), HasSubstr("study.toml:4: optimisers"));
  EXPECT_THAT(error_of(kFits + "optimizers = ['ga',\n'gaa']\n"), HasSubstr("study.toml:5"));
  EXPECT_THAT(error_of(kFits + "optimizers = [{name = 'ga', populaton = 3}]\n"), HasSubstr("population"));
  EXPECT_THAT(error_of(kFits + "optimizers = [{name = 'ga', population = 'many'}]\n"),
              HasSubstr("study.toml:4: population: got 'many', expected a number"));
  EXPECT_THAT(error_of("[fits]\ntargets = ['fir',\n\n'furr']\n"),
              HasSubstr("study.toml:4: targets: got 'furr'"));
  EXPECT_THAT(error_of("[fits]\ntargets = []\n"), HasSubstr("study.toml:2: targets: got an array of 0"));
  EXPECT_THAT(error_of("[fits]\ntargets = [{species = 'oak_of_nowhere'}]\n"), HasSubstr("study.toml:2"));
  EXPECT_THAT(error_of(kFits + "seeds = []\n"), HasSubstr("study.toml:4"));
  EXPECT_THAT(error_of(kFits + "seeds = [-1]\n"), HasSubstr("study.toml:4"));
  EXPECT_THAT(error_of(kFits + "seeds = 0\n"), HasSubstr("study.toml:4"));
  EXPECT_THAT(error_of(kFits + "objectives = ['iuo']\n"), HasSubstr("study.toml:4"));
  EXPECT_THAT(error_of(kFits + "optimizers = [{name = 'ga', population = 'many'}]\n"),
              HasSubstr("study.toml:4: population: got 'many', expected a number"));
  EXPECT_THAT(error_of(kFits + "spaces = [{free = ['g_scal']}]\n"), HasSubstr("g_scale"));
  EXPECT_THAT(error_of(kFits + "view = 'front'\n"), HasSubstr("study.toml:4"));
  EXPECT_THAT(error_of(kFits + "size = 3\n"), HasSubstr("study.toml:4: size: got 3"));
  EXPECT_THAT(error_of(kFits + "seconds = nan\n"), HasSubstr("study.toml:4"));
  EXPECT_THAT(error_of("titel = 'x'\n" + kFits), HasSubstr("study.toml:1: titel"));
  EXPECT_THAT(error_of("title = 'x'\n"), HasSubstr("got 0 of the tables"));
  EXPECT_THAT(error_of(kFits + "[growth]\n"), HasSubstr("got 2 of the tables"));
  EXPECT_THAT(error_of("[growth]\nspecies = []\n"), HasSubstr("study.toml:2"));
  EXPECT_THAT(error_of("[pictures]\nspecies = 'palm'\ncolumns = [{set = {flaer = 1}}]\n"),
              HasSubstr("flare"));
  EXPECT_THAT(error_of("[pictures]\nspecies = 'palm'\ncolumns = [{prune_to = 'ball:1'}]\n"),
              HasSubstr("ball"));
  EXPECT_THAT(error_of("[fits\n"), HasSubstr("study.toml:1"));
  EXPECT_THAT(error_of("published_fitness = [2, 1]\n" + kFits), HasSubstr("study.toml:1"));
}

/// The options of a fit that an experiment has for all its runs.
std::vector<FitOption> shared_options() {
  std::vector<FitOption> shared;
  for (const FitOption& option : fit_options())
    if (!experiment_key(option).empty()) shared.push_back(option);
  return shared;
}

/// TOML of the sample; a flag that turns its member off says the opposite.
std::string toml_of(const FitOption& option, const OptionValue& value) {
  return option.inverted ? to_toml(!std::get<bool>(value)) : to_toml(value);
}

// Without evaluations, which are an option too.
const std::string kTargets = "[fits]\ntargets = ['oc_palm']\n";

TEST(ReadExperiment, EachOptionOfAFitIsAKey) {
  EXPECT_GT(shared_options().size(), 12u);
  for (const FitOption& option : shared_options()) {
    const OptionValue another = sample_of(option).another;
    const std::string line = experiment_key(option) + " = " + toml_of(option, another) + "\n";
    const FitRecord record = read_experiment(file_with(kTargets + line)).fits->record;
    EXPECT_EQ(to_words(get_value(option, record)), to_words(another)) << line;
  }
}

TEST(ReadExperiment, EachOptionRefusesAWrongTypeABadValueAndAnotherName) {
  for (const FitOption& option : shared_options()) {
    const std::string key = experiment_key(option);
    const OptionSample sample = sample_of(option);
    std::vector<std::string> bad = sample.bad;
    bad.push_back(sample.of_wrong_type);
    if (option.zero_is_none) bad.push_back("0");
    for (const std::string& value : bad)
      EXPECT_THAT(error_of(kTargets + key + " = " + value + "\n"),
                  AllOf(HasSubstr("study.toml:3: " + key + ": got "), HasSubstr(", expected ")))
          << value;
    EXPECT_THAT(
        error_of(kTargets + "x" + key + " = 1\n"),
        AllOf(HasSubstr("study.toml:3: x" + key + ": got an unknown key"), HasSubstr("'" + key + "'")));
  }
}

TEST(ReadExperiment, EachListRefusesWhatNoRunCanUse) {
  const std::pair<const char*, const char*> bad_lists[] = {
      {"optimizers", "['gaa']"},
      {"optimizers", "[{name = 'ga', population = -1}]"},
      {"objectives", "['iuo']"},
      {"objectives", "'iou'"},
      {"spaces", "['few']"},
      {"spaces", "['default', {free = ['g_scale']}]"},
      {"spaces", "[{label = 'a'}, {label = 'a', free = ['g_scale']}]"},
      {"spaces", "[{first = 'species:0'}]"},
      {"starts", "['random:0']"},
      {"starts", "['auto,-oak_of_nowhere']"},
      {"exclude_truth", "'yes'"},
      {"spaces", "[{first = 'species:99'}]"},
      {"spaces", "[{free = 'g_scale'}]"},
      {"spaces", "[{free = ['g_scal']}]"},
      {"spaces", "[{fixed = {levels = 9}}]"},
      {"spaces", "[{fixed = {leaf_shape = 'elm'}}]"},
      {"spaces", "[{fixed = {leaf_shape = '0x3'}}]"},
      {"spaces", "[{fixed = {levls = 2}}]"},
      {"starts", "['nopreset']"},
      {"starts", "['acer.lsys']"},
      {"starts", "'auto'"},
      {"seeds", "['one']"},
      {"seeds", "1.5"},
      {"trained", "['yes']"},
      {"trained", "true"},
      {"threads", "0"},
      {"threads", "'all'"},
      {"unseen_seeds", "-1"},
      {"siblings", "-1"},
      {"view", "7"},
      {"view", "'0,91'"},
      {"groups", "{odd = ['oak']}"},
      {"groups", "7"},
  };
  for (const auto& [key, value] : bad_lists)
    EXPECT_THAT(
        error_of(kFits + key + " = " + value + "\n"),
        AllOf(HasSubstr(fmt::format("study.toml:4: {}: ", key)), HasSubstr("got "), HasSubstr("expected ")))
        << value;
}

TEST(ReadExperiment, FixedParametersTakeNamesOfChoices) {
  const auto fixed = [](const std::string& value) {
    const std::string line = "spaces = [{fixed = {leaf_shape = " + value + "}}]\n";
    return read_experiment(file_with(kFits + line)).fits->spaces[0].search.fixed.at("leaf_shape");
  };
  EXPECT_EQ(fixed("'ovate'"), fixed("1"));
}

TEST(ReadExperiment, AnLSystemLiesBesideTheExperimentOrIsBundled) {
  const fs::path file = file_with(kFits +
                                  "model = 'own.lsys'\nspaces = ['default', {label = 'pine', model = "
                                  "'small_pine.lsys'}, {label = 'wp', model = 'weber_penn'}]\n");
  fs::copy_file(ESPALIER_SOURCE_DIR "/src/lsystem/models/small_pine.lsys", file.parent_path() / "own.lsys");
  const FitsDeclaration fits = *read_experiment(file).fits;
  ASSERT_EQ(fits.spaces.size(), 3u);
  EXPECT_EQ(fits.spaces[0].model, (file.parent_path() / "own.lsys").string());
  EXPECT_EQ(fits.spaces[1].model, "small_pine.lsys");
  EXPECT_EQ(fits.spaces[2].model, "weber_penn");
  EXPECT_EQ(fits.spaces[2].growth.max_stems, FitRecord{}.growth.max_stems);
  EXPECT_GE(fits.spaces[1].growth.max_stems, fits.spaces[2].growth.max_stems);
  const Plan plan = plan_of(read_experiment(file), fresh_folder("lsystem_plan"));
  EXPECT_EQ(plan.runs.size(), 3u);
}

TEST(ReadExperiment, ModelsThatCannotDoWhatIsAskedAreRefused) {
  EXPECT_THAT(error_of(kFits + "model = 'none.lsys'\n"), HasSubstr("study.toml:4: model: got"));
  EXPECT_THAT(error_of(kFits + "spaces = [{label = 'x', model = 'none.lsys'}]\n"),
              HasSubstr("study.toml:4: spaces: got"));
  const std::string pine = "spaces = ['default', {label = 'pine', model = 'small_pine.lsys'}]\n";
  EXPECT_THAT(error_of(kFits + pine + "starts = ['acer']\n"), HasSubstr("study.toml:5: starts: "));
  EXPECT_THAT(error_of(kFits + pine + "trained = [true]\n"),
              AllOf(HasSubstr("study.toml:5: trained: got true"), HasSubstr("small_pine.lsys")));
  EXPECT_THAT(error_of(kFits + "spaces = [{label = 'x', model = 'small_pine.lsys', free = ['g_scale']}]\n"),
              HasSubstr("study.toml:4: spaces: "));
}

TEST(ReadExperiment, ATargetMayHaveSeveralViews) {
  const auto views = [](const std::string& target) {
    return read_experiment(file_with("[fits]\nevaluations = 10\nview = '10,5'\ntargets = [" + target + "]\n"))
        .fits->targets[0];
  };
  const TargetDeclaration pictures =
      views("{picture = 'oc_palm', views = ['fir:90,0', 'oc_palm:180,10,40']}");
  ASSERT_EQ(pictures.views.size(), 3u);
  EXPECT_EQ(pictures.name, "oc_palm");
  EXPECT_EQ(pictures.views[0].view.azimuth_deg, 10);
  EXPECT_EQ(pictures.views[1].picture.filename(), "fir.png");
  EXPECT_EQ(pictures.views[1].view.azimuth_deg, 90);
  EXPECT_EQ(pictures.views[2].view.field_of_view_deg, 40);
  const TargetDeclaration alone = views("{views = ['fir:90,0']}");
  ASSERT_EQ(alone.views.size(), 1u);
  EXPECT_EQ(alone.name, "fir");
  EXPECT_EQ(alone.views[0].view.azimuth_deg, 90);
  const TargetDeclaration drawn = views("{species = 'palm', views = ['90,0']}");
  ASSERT_EQ(drawn.views.size(), 2u);
  EXPECT_EQ(drawn.views[0].view.elevation_deg, 5);
  EXPECT_EQ(drawn.views[1].view.azimuth_deg, 90);
}

TEST(ReadExperiment, ViewsThatAreNoneAreRefused) {
  const std::pair<const char*, const char*> bad[] = {
      {"{picture = 'oc_palm', views = []}", "views: got an array of 0"},
      {"{picture = 'oc_palm', views = ['nowhere:90,0']}", "got 'nowhere'"},
      {"{picture = 'oc_palm', views = ['fir:90']}", "got 'fir:90', expected FILE:AZIMUTH,ELEVATION"},
      {"{picture = 'oc_palm', views = 'fir:90,0'}", "views: got 'fir:90,0'"},
      {"{species = 'palm', views = ['90']}", "got '90', expected AZIMUTH,ELEVATION in degrees"},
      {"{species = 'palm', views = ['500,0']}", "got 500, expected an azimuth"},
      {"{species = 'palm', picture = 'oc_palm'}", "picture: got 'oc_palm', expected none"},
      {"{name = 'x'}", "picture"},
  };
  for (const auto& [target, words] : bad)
    EXPECT_THAT(error_of("[fits]\ntargets = [" + std::string(target) + "]\n"),
                AllOf(HasSubstr("study.toml:2: "), HasSubstr(words)))
        << target;
}

TEST(ReadExperiment, ASettingIsADecimalNumberAWordOrToml) {
  const auto record = [](const std::string& setting) {
    return read_experiment(file_with(kFits), {setting}).fits->record;
  };
  EXPECT_EQ(record("evaluations=20").budget.evaluations, 20);
  EXPECT_EQ(record("seconds=1e-1").budget.seconds, 0.1);
  EXPECT_EQ(record("kind=leafless").kind, KindChoice::leafless);
  EXPECT_EQ(record("kind=\"palm\"").kind, KindChoice::palm);
  EXPECT_EQ(read_experiment(file_with(kFits), {"seeds=[4, 5]"}).fits->seeds, (std::vector<Seed>{4, 5}));
  for (const char* setting :
       {"evaluations=0x10", "evaluations=", "evaluations", "=3", "kind=leavy", "seconds=nan"})
    EXPECT_THROW(record(setting), InputError) << setting;
}

TEST(ReadExperiment, WordsAndCommentsDoNotMakeAnotherExperiment) {
  EXPECT_TRUE(same_runs(kFits, "# comment\ntitle = 'new'\n" + kFits));
  EXPECT_FALSE(same_runs(kFits, kFits + "seeds = 2\n"));
}

/// Of whole numbers from 0.
std::string list_of(int count) {
  std::string text = "[0";
  for (int i = 1; i < count; ++i) text += "," + std::to_string(i);
  return text + "]";
}

TEST(ReadExperiment, RunsAreCountedBeforeTheyAreMade) {
  const std::string ten = "optimizers = ['all']\nobjectives = ['iou', 'dice', 'gap_iou']\nseeds = ";
  EXPECT_EQ(error_of(kFits + ten + "100"), "no error");
  EXPECT_THAT(error_of(kFits + ten + "10000"),
              testing::ContainsRegex(
                  "study.toml:1: got 1[0-9]+ runs, every combination of the lists, expected at most 100000"));
}

TEST(ReadExperiment, ListsAreOfBoundedLength) {
  EXPECT_EQ(error_of(kFits + "seeds = " + list_of(10'000)), "no error");
  EXPECT_THAT(error_of(kFits + "seeds = " + list_of(10'001)),
              HasSubstr("study.toml:4: seeds: got an array of 10001, expected at most 10000 values"));
}

TEST(ReadExperiment, SheetsHaveABoundedNumberOfPictures) {
  std::string rows, columns;
  for (int i = 0; i < 101; ++i) {
    rows += "[[pictures.rows]]\nlabel = 'r" + std::to_string(i) + "'\n";
    columns += "[[pictures.columns]]\nlabel = 'c" + std::to_string(i) + "'\n";
  }
  EXPECT_THAT(error_of("[pictures]\nspecies = 'palm'\n" + rows + columns),
              HasSubstr("study.toml:1: got 10201 runs"));
}

}  // namespace
}  // namespace espalier
