// The score sheet of closeness.toml, with budgets so small that it repeats and takes seconds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/csv.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kSheet = ESPALIER_SOURCE_DIR "/experiments/closeness.toml";

std::string arguments_of(const fs::path& out) {
  return "experiment run '" + kSheet + "' --out '" + out.string() +
         "' --quiet --set 'targets=[\"oc_palm\",\"oc_orange\"]' --set 'seeds=[1,2]' --set evaluations=30 "
         "--set branch_rounds=3 --set size=32 --set max_stems=150 --set max_leaves=600 --set "
         "'starts=[\"palm\"]'";
}

double number_of(const CsvTable& table, const std::vector<std::pair<std::string, std::string>>& where,
                 const std::string& column) {
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    bool is_meant = true;
    for (const auto& [name, value] : where) is_meant = is_meant && table.text(row, name) == value;
    if (is_meant) return table.number(row, column);
  }
  ADD_FAILURE() << "no such row";
  return -1;
}

TEST(ScoreSheet, NamesEveryShippedPictureOnceAndInOneGroup) {
  const Experiment experiment = read_experiment(kSheet);
  std::vector<std::string> targets, members;
  for (const auto& target : experiment.fits->targets) targets.push_back(target.name);
  for (const auto& [group, names] : experiment.fits->groups)
    members.insert(members.end(), names.begin(), names.end());
  EXPECT_EQ(targets.size(), 21u);
  EXPECT_THAT(members, testing::UnorderedElementsAreArray(targets));
  EXPECT_EQ(experiment.fits->record.budget.branch_rounds, kWhileTimeLasts);
  EXPECT_EQ(experiment.fits->objectives, std::vector<std::string>{kFitObjective});
  EXPECT_EQ(experiment.fits->threads, 2);
}

fs::path reported_sheet(const std::string& name) {
  const fs::path out = fresh_folder(name) / "out";
  EXPECT_EQ(run_espalier(arguments_of(out)).exit_code, 0);
  EXPECT_EQ(run_espalier("experiment report '" + out.string() + "'").exit_code, 0);
  return out;
}

/// The sheet that tests look at.
const fs::path& shared_sheet() {
  static const fs::path out = reported_sheet("score_sheet");
  return out;
}

TEST(ScoreSheet, HoldsEachStageAndTheBaselineAndIsTheSameTwice) {
  const fs::path report = shared_sheet() / "report";
  EXPECT_EQ(read_text_file(report / "score_sheet.csv"),
            read_text_file(reported_sheet("score_sheet_again") / "report/score_sheet.csv"));
  const CsvTable targets = read_csv(report / "score_sheet.csv"),
                 groups = read_csv(report / "score_groups.csv");
  EXPECT_EQ(targets.rows.size(), 2u * (1 + 2 * 4))
      << "targets × (baseline, methods × (search, branches, finish, full size))";
  for (const char* target : {"oc_palm", "oc_orange"}) {
    EXPECT_EQ(number_of(targets, {{"target", target}, {"method", "outline, no tree"}}, "outline_iou"), 1);
    EXPECT_EQ(number_of(targets, {{"target", target}, {"method", "outline, no tree"}}, "gap_iou"), 0);
    for (const char* stage : {"branches", "finish", "at 512 px"})
      EXPECT_EQ(number_of(targets, {{"target", target}, {"method", "trained"}, {"stage", stage}}, "runs"), 2)
          << stage;
  }
  const auto iou = [&](const std::string& group) {
    return number_of(groups, {{"group", group}, {"method", "plain"}, {"stage", "search"}}, "iou");
  };
  EXPECT_NEAR(iou("all"), (iou("palms") + iou("solid crowns")) / 2, 0.0011);
  const std::string page = read_text_file(report / "index.html");
  EXPECT_THAT(page, HasSubstr("Score sheet"));
  EXPECT_THAT(page, HasSubstr("oc_orange"));
  EXPECT_TRUE(fs::exists(report / "tree_oc_palm-plain-1.png") ||
              fs::exists(report / "tree_oc_palm-plain-2.png"));
}

/// The mean of a target's runs of a method, seed by seed.
double mean_of_runs(const CsvTable& results, const std::string& target, const std::string& method,
                    const std::string& metric) {
  double sum = 0, count = 0;
  for (std::size_t row = 0; row < results.rows.size(); ++row)
    if (results.text(row, "target") == target && results.text(row, "trained") == method) {
      sum += results.number(row, metric);
      ++count;
    }
  EXPECT_EQ(count, 2);
  return sum / count;
}

TEST(ScoreSheet, TheLastStageIsWhatTheTableOfRunsHolds) {
  const CsvTable results = read_csv(shared_sheet() / "results.csv"),
                 sheet = read_csv(shared_sheet() / "report/score_sheet.csv");
  for (const char* target : {"oc_palm", "oc_orange"})
    for (const char* method : {"plain", "trained"})
      for (const char* metric : {"iou", "tolerant_iou", "outline_iou", "gap_iou"})
        EXPECT_NEAR(number_of(sheet, {{"target", target}, {"method", method}, {"stage", "finish"}}, metric),
                    mean_of_runs(results, target, method, metric), 0.0006)
            << target << " " << method << " " << metric;
}

TEST(ScoreSheet, SettingsThatAreNoneAreRefused) {
  const fs::path out = fresh_folder("score_settings") / "out";
  const auto refused = [&](const std::string& setting, const std::string& words) {
    const ProgramRun run =
        run_espalier("experiment run '" + kSheet + "' --out '" + out.string() + "' --set " + setting);
    expect_one_clear_error(run);
    EXPECT_THAT(run.err, HasSubstr(words));
  };
  refused("secnds=2", "secnds");
  refused("seconds=", "--set: got 'seconds='");
  refused("seconds=-1", "seconds");
  refused("'trained=[1]'", "trained");
  refused("'groups={odd=[\"oak\"]}'", "'oak' in group 'odd'");
  refused("'branch_rounds=\"ever\"'", "branch_rounds");
  EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace espalier
