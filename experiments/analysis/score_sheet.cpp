#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/experiments/analysis/score_sheet.h>
#include <espalier/experiments/analysis/tree_picture.h>
#include <espalier/experiments/runner/experiment_directory.h>
#include <espalier/experiments/runner/plan.h>
#include <espalier/image/measures/compare.h>
#include <espalier/image/measures/metrics_json.h>
#include <espalier/image/reading/read_target.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kNoTree = "outline, no tree";
constexpr const char* kAll = "all";

/// What is compared: a method after one of its stages.
struct Entry {
  std::string method, stage;
  auto operator<=>(const Entry&) const = default;  // NOLINT(modernize-use-nullptr): of its own 0
};

/// The runs of one entry on one target.
struct Scores {
  std::vector<MaskMetrics> runs;

  double mean(std::size_t metric) const {
    double sum = 0;
    for (const MaskMetrics& run : runs) sum += run.values[metric];
    return sum / static_cast<double>(runs.size());
  }
  /// The largest IoU less the smallest.
  double spread() const {
    const auto [least, most] =
        std::minmax_element(runs.begin(), runs.end(),
                            [](const MaskMetrics& a, const MaskMetrics& b) { return a["iou"] < b["iou"]; });
    return (*most)["iou"] - (*least)["iou"];
  }
};

/// The scores by target, then by entry.
struct AllScores {
  std::vector<std::string> targets;
  std::vector<Entry> entries;
  std::map<std::pair<std::string, Entry>, Scores> scores;

  void add(const std::string& target, const Entry& entry, const MaskMetrics& metrics) {
    if (std::find(entries.begin(), entries.end(), entry) == entries.end()) entries.push_back(entry);
    scores[{target, entry}].runs.push_back(metrics);
  }
};

/// Traces of earlier versions lack the measures that are younger.
MaskMetrics row_of(const CsvTable& trace, std::size_t row) {
  MaskMetrics metrics;
  for (std::size_t i = 0; i < kMetricCount; ++i)
    metrics.values[i] = trace.has(kMetrics[i].name) ? trace.number(row, kMetrics[i].name) : NAN;
  return metrics;
}

/// The metrics after each stage of a run, "starts" apart; stages that follow each other in the trace.
void add_stages(const FinishedFit& fit, const fs::path& run, AllScores& all) {
  const CsvTable trace = read_csv(run / "trace.csv");
  for (std::size_t row = 0; row < trace.rows.size(); ++row) {
    const std::string& stage = trace.text(row, "stage");
    const bool is_last = row + 1 == trace.rows.size() || trace.text(row + 1, "stage") != stage;
    if (is_last && stage != "starts") all.add(fit.target, {fit.method, stage}, row_of(trace, row));
  }
}

/// Those of the tree in larger masks than the search's, where the run looked at such.
void add_full_size(const FinishedFit& fit, const fs::path& run, AllScores& all) {
  const auto summary = nlohmann::json::parse(read_file(run / "summary.json"), nullptr, false);
  if (summary.is_discarded() || !summary.contains("full_size"))
    return;  // of earlier versions, or without a refinement
  const auto& seen = summary["full_size"];
  all.add(fit.target, {fit.method, fmt::format("at {} px", seen.value("size_px", 0))},
          seen.get<MaskMetrics>());
}

/// The closed and filled outline of the target against the target.
MaskMetrics outline_alone(const fs::path& run) {
  const TargetOptions written{.separation = {.method = SeparationMethod::luminance, .side = TreeSide::light}};
  const PreparedTarget target(read_mask(run / "target.png", written).mask);
  return compare_masks(target.outline(), target);
}

AllScores read_scores(const std::vector<FinishedFit>& fits, const fs::path& directory) {
  AllScores all;
  for (const FinishedFit& fit : fits) {
    if (fit.failed) continue;
    const fs::path run = run_directory(directory, fit.run);
    if (std::find(all.targets.begin(), all.targets.end(), fit.target) == all.targets.end()) {
      all.targets.push_back(fit.target);
      all.add(fit.target, {kNoTree, ""}, outline_alone(run));
    }
    add_stages(fit, run, all);
    add_full_size(fit, run, all);
  }
  return all;
}

std::string group_of(const std::string& target, const TargetGroups& groups) {
  for (const auto& [group, members] : groups)
    if (std::find(members.begin(), members.end(), target) != members.end()) return group;
  return "";
}

std::vector<std::string> numbers_of(const MaskMetrics& metrics, double spread) {
  std::vector<std::string> cells;
  for (const double value : metrics.values)
    cells.push_back(std::isnan(value) ? "" : fmt::format("{:.3f}", value));
  cells.push_back(fmt::format("{:.3f}", spread));
  return cells;
}

MaskMetrics means_of(const Scores& scores) {
  MaskMetrics means;
  for (std::size_t i = 0; i < kMetricCount; ++i) means.values[i] = scores.mean(i);
  return means;
}

std::vector<std::string> columns_after(std::vector<std::string> columns) {
  for (const Metric& metric : kMetrics) columns.emplace_back(metric.name);
  columns.emplace_back("spread_of_iou");
  return columns;
}

CsvTable target_table(const AllScores& all, const TargetGroups& groups) {
  CsvTable table{columns_after({"target", "group", "method", "stage", "runs"}), {}, "score_sheet.csv"};
  for (const std::string& target : all.targets)
    for (const Entry& entry : all.entries) {
      const auto found = all.scores.find({target, entry});
      if (found == all.scores.end()) continue;
      std::vector<std::string> row{target, group_of(target, groups), entry.method, entry.stage,
                                   fmt::format("{}", found->second.runs.size())};
      const auto numbers = numbers_of(means_of(found->second), found->second.spread());
      row.insert(row.end(), numbers.begin(), numbers.end());
      table.rows.push_back(std::move(row));
    }
  return table;
}

/// Means of the targets' means.
void add_group(const std::string& group, const std::vector<std::string>& members, const AllScores& all,
               CsvTable& table) {
  for (const Entry& entry : all.entries) {
    MaskMetrics sum;
    double spread = 0, count = 0;
    for (const std::string& target : members) {
      const auto found = all.scores.find({target, entry});
      if (found == all.scores.end()) continue;
      for (std::size_t i = 0; i < kMetricCount; ++i) sum.values[i] += found->second.mean(i);
      spread += found->second.spread(), ++count;
    }
    if (count == 0) continue;
    for (double& value : sum.values) value /= count;
    std::vector<std::string> row{group, fmt::format("{}", count), entry.method, entry.stage};
    const auto numbers = numbers_of(sum, spread / count);
    row.insert(row.end(), numbers.begin(), numbers.end());
    table.rows.push_back(std::move(row));
  }
}

CsvTable group_table(const AllScores& all, const TargetGroups& groups) {
  CsvTable table{columns_after({"group", "pictures", "method", "stage"}), {}, "score_groups.csv"};
  add_group(kAll, all.targets, all, table);
  for (const auto& [group, members] : groups) add_group(group, members, all, table);
  return table;
}

/// The run of median fitness, the better of two.
const FinishedFit* median_run(const std::vector<FinishedFit>& fits, const std::string& target,
                              const std::string& method) {
  std::vector<const FinishedFit*> runs;
  for (const FinishedFit& fit : fits)
    if (!fit.failed && fit.target == target && fit.method == method) runs.push_back(&fit);
  std::stable_sort(runs.begin(), runs.end(),
                   [](const auto* a, const auto* b) { return a->fitness > b->fitness; });
  return runs.empty() ? nullptr : runs[(runs.size() - 1) / 2];
}

Json shown_run(const FinishedFit& fit, const fs::path& directory) {
  const std::string run = "../runs/" + fit.run, tree = fmt::format("tree_{}.png", fit.run);
  write_png(directory / "report" / tree, draw_fitted_tree(run_directory(directory, fit.run)));
  return {{"label", fmt::format("{}, seed {}", fit.method, fit.seed)},
          {"fit", run + "/best.png"},
          {"overlay", run + "/overlay.png"},
          {"tree", tree}};
}

Json page_of(const std::string& target, const std::vector<FinishedFit>& fits, const CsvTable& table,
             const fs::path& directory) {
  Json page = {{"target", target}, {"fits", Json::array()}, {"rows", Json::array()}};
  for (const std::string& method : in_order(fits, &FinishedFit::method)) {
    const FinishedFit* run = median_run(fits, target, method);
    if (!run) continue;
    page["picture"] = "../runs/" + run->run + "/target.png";
    page["fits"].push_back(shown_run(*run, directory));
  }
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (table.text(row, "target") == target) page["rows"].push_back(table.rows[row]);
  page["group"] = table.text(0, "group");
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (table.text(row, "target") == target) page["group"] = table.text(row, "group");
  return page;
}

}  // namespace

ScoreSheet score_sheet(const std::vector<FinishedFit>& fits, const TargetGroups& groups,
                       const fs::path& directory) {
  const AllScores all = read_scores(fits, directory);
  ScoreSheet sheet{target_table(all, groups), group_table(all, groups), {}};
  sheet.pages["columns"] = sheet.targets.columns;
  sheet.pages["targets"] = Json::array();
  for (const std::string& target : all.targets)
    sheet.pages["targets"].push_back(page_of(target, fits, sheet.targets, directory));
  return sheet;
}

}  // namespace espalier
