// What a study that has runs may be given, and the line that names what it may not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include <espalier/core/error.h>
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/declaration/experiment_keys.h>

#include "support/option_samples.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Experiment experiment_of(const std::string& text) {
  return read_experiment_text(text, fresh_folder("grown") / "study.toml");
}

std::string change(const std::string& was, const std::string& is) {
  return change_of_runs(experiment_of(was), experiment_of(is));
}

std::string merge_error(const std::string& text) {
  try {
    experiment_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

const std::string kTarget = "[fits]\ntargets = ['oc_palm']\n";
const std::string kStudy = kTarget + "evaluations = 10\n";

TEST(GrownExperiment, EachListMayGrowAtAnyPlace) {
  const std::pair<const char*, const char*> grown[] = {
      {"optimizers = ['cma_es']", "optimizers = ['ga', 'cma_es', {name = 'ga', population = 8}]"},
      {"", "optimizers = ['ga', 'cma_es']"},
      {"objectives = ['iou']", "objectives = ['dice', 'iou']"},
      {"", "spaces = ['default', {label = 'few', free = ['g_scale']}]"},
      {"", "starts = ['palm', 'auto']"},
      {"", "trained = [true, false]"},
      {"seeds = 3", "seeds = 4"},
      {"seeds = [7]", "seeds = [1, 7]"},
      {"", "groups = {all = ['oc_palm']}"},
      {"", "optimizers = ['cma_es']\nseeds = [1]\nunseen_seeds = 0"},
  };
  for (const auto& [was, is] : grown)
    EXPECT_EQ(change(kStudy + was + "\n", kStudy + is + "\n"), "") << was << " to " << is;
  EXPECT_EQ(change(kStudy, "[fits]\ntargets = ['fir', 'oc_palm']\nevaluations = 10\n"), "");
}

TEST(GrownExperiment, WhatRunsHaveStays) {
  struct Case {
    std::string was, is, key, words;
  };
  const Case cases[] = {
      {"seeds = 3", "seeds = 2", "seeds", "'3'"},
      {"optimizers = ['ga', 'cma_es']", "optimizers = ['cma_es']", "optimizers", "'ga'"},
      {"optimizers = [{name = 'ga', population = 60, label = 'large'}]",
       "optimizers = [{name = 'ga', population = 80, label = 'large'}]", "optimizers", "population = 80"},
      {"objectives = ['iou']", "objectives = ['dice']", "objectives", "'iou'"},
      {"spaces = [{label = 'few', free = ['g_scale']}]", "spaces = [{label = 'few', free = ['ratio']}]",
       "spaces", "free = [ratio]"},
      {"", "starts = ['palm']", "starts", "'auto'"},
      {"", "unseen_seeds = 4", "unseen_seeds", "got 4, expected 0"},
      {"", "siblings = 2", "siblings", "got 2, expected 0"},
      {"", "exclude_truth = false", "exclude_truth", "got false, expected true"},
      {"", "view = '30,0'", "view", "got 30,0, expected 0,0"},
      {"", "threads = 2", "threads", "got 2, expected 1"},
  };
  for (const auto& [was, is, key, words] : cases)
    EXPECT_THAT(change(kStudy + was + "\n", kStudy + is + "\n"),
                AllOf(testing::StartsWith(key + ": got "), HasSubstr(", expected "), HasSubstr(words)))
        << is;
  EXPECT_THAT(change(kStudy, "[fits]\ntargets = ['fir']\nevaluations = 10\n"), HasSubstr("'oc_palm'"));
  EXPECT_THAT(change(kStudy, "[growth]\n"), HasSubstr("of [growth], expected one of [fits]"));
}

TEST(GrownExperiment, NoOptionOfTheFitsMayChange) {
  for (const FitOption& option : fit_options()) {
    const std::string key = experiment_key(option);
    if (key.empty()) continue;
    const OptionValue value = sample_of(option).another;
    const std::string text = option.inverted ? to_toml(!std::get<bool>(value)) : to_toml(value);
    EXPECT_THAT(change(kTarget, kTarget + key + " = " + text + "\n"), testing::StartsWith(key + ": got "));
  }
}

TEST(GrownExperiment, SheetsAndGrowthMayGrowToo) {
  const std::string sheet = "[pictures]\nspecies = 'palm'\ncolumns = [{label = 'a'}";
  EXPECT_EQ(change(sheet + "]\n", sheet + ", {label = 'b', set = {flare = 2}}]\nrows = [{label = ''}]\n"),
            "");
  EXPECT_THAT(change(sheet + "]\n", "[pictures]\nspecies = 'palm'\ncolumns = [{label = 'a', t = 0.3}]\n"),
              "");
  EXPECT_THAT(change(sheet + "]\n",
                     "[pictures]\nspecies = 'palm'\ncolumns = [{label = 'a', set = {flare = "
                     "2}}]\n"),
              HasSubstr("columns: got {flare = 2}, expected {}"));
  EXPECT_THAT(change(sheet + "]\n", sheet + "]\nsize = 64\n"), HasSubstr("size: got 64, expected 320"));
  EXPECT_EQ(change("[growth]\nspecies = ['palm']\n", "[growth]\nspecies = ['acer', 'palm']\n"), "");
  EXPECT_THAT(change("[growth]\nseeds = 3\n", "[growth]\nseeds = 4\n"),
              HasSubstr("seeds: got 4, expected 3"));
}

TEST(GrownExperiment, ValuesThatTablesWouldMergeAreRefusedByBothNames) {
  struct Case {
    std::string text, first, second;
  };
  const Case cases[] = {
      {"spaces = ['default', {free = ['g_scale']}]", "got default and", "{free = [g_scale]}"},
      {"spaces = [{fixed = {levels = 2}}, {first = 'species:2'}]", "{fixed = {levels = 2}} and",
       "{first = species:2}"},
      {"optimizers = ['ga', {name = 'ga'}]", "{name = ga} and", "'ga'"},
      {"optimizers = [{name = 'ga', label = 'x'}, {name = 'cma_es', label = 'x'}]", "{name = ga} and",
       "{name = cma_es}"},
      {"objectives = ['iou', 'iou']", "iou and iou", "'iou'"},
      {"starts = ['auto', 'auto']", "auto and auto", "'auto'"},
      {"seeds = [4, 4]", "4 and 4", "'4'"},
  };
  for (const auto& [text, first, second] : cases)
    EXPECT_THAT(merge_error(kStudy + text + "\n"),
                AllOf(HasSubstr("study.toml:4: "), HasSubstr(first), HasSubstr(second),
                      HasSubstr("expected another label for one of them")))
        << text;
  EXPECT_THAT(merge_error("[fits]\ntargets = [{species = 'acer'}, {species = 'acer', seed = 2}]\n"),
              AllOf(HasSubstr("{species = acer, seed = 1} and {species = acer, seed = 2}"),
                    HasSubstr("both labelled 'acer'")));
  EXPECT_THAT(
      merge_error("[pictures]\nspecies = 'palm'\nrows = [{set = {flare = 1}}, {set = {flare = 2}}]\n"),
      HasSubstr("{flare = 1} and {flare = 2}"));
}

/// Defaults that TOML can say, written out, ask for the same.
TEST(GrownExperiment, DefaultsInTheTableOfKeysAreTheDefaults) {
  int count = 0;
  for (const auto& key : fits_keys()) {
    const std::string& otherwise = key.words.otherwise;
    if (otherwise.empty() || otherwise.find(" with ") != std::string::npos) continue;
    const bool is_toml = otherwise.find_first_not_of("-+.0123456789e") == std::string::npos ||
                         otherwise.find_first_of("['") == 0 || otherwise == "true" || otherwise == "false";
    const std::string text = is_toml ? otherwise : "'" + otherwise + "'";
    EXPECT_EQ(change(kTarget, kTarget + key.words.key + " = " + text + "\n"), "") << key.words.key;
    ++count;
  }
  EXPECT_GT(count, 20);
}

TEST(GrownExperiment, TheTableOfKeysNamesEachKeyOnce) {
  const std::string table = experiment_keys_as_markdown();
  for (const std::string& key : names_of(fits_keys()))
    EXPECT_THAT(table, HasSubstr("| `" + key + "` |")) << key;
  std::vector<std::string> names = names_of(fits_keys());
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

}  // namespace
}  // namespace espalier
