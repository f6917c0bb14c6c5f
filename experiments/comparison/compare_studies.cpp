#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/experiments/analysis/finished_fits.h>
#include <espalier/experiments/comparison/compare_studies.h>
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/experiment_directory.h>
#include <espalier/experiments/runner/plan.h>
#include <espalier/experiments/statistics/paired_tests.h>
#include <espalier/experiments/statistics/quantiles.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

constexpr double kCoverage = 0.95;

bool contains(const Names& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

void add_new(Names& names, const std::string& name) {
  if (!contains(names, name)) names.push_back(name);
}

/// results.csv of a study of fits, and what varies in it.
struct Study {
  fs::path directory;
  CsvTable results;
  Names methods_of_rows, targets, methods, seeds, objectives;
};

void check_finished(const Study& study) {
  const std::size_t runs = study.targets.size() * study.methods.size() * study.seeds.size();
  if (runs != study.results.rows.size())
    throw_input_error("{}: got {} of {} runs, expected a finished study (espalier experiment run)",
                      study.directory.string(), study.results.rows.size(), runs);
}

Study read_study(const fs::path& directory) {
  const fs::path declaration = directory / "experiment.toml";
  std::error_code error;
  if (!fs::is_regular_file(declaration, error))
    throw_input_error("{}: got no experiment.toml in it, expected the directory of an experiment",
                      directory.string());
  if (const std::string kind = read_metadata(declaration).kind; kind != "fits")
    throw_input_error("{}: got an experiment of [{}], expected one of [fits]", directory.string(), kind);
  Study study{directory, read_csv(directory / "results.csv"), {}, {}, {}, {}, {}};
  for (std::size_t row = 0; row < study.results.rows.size(); ++row) {
    study.methods_of_rows.push_back(method_of(study.results, row));
    add_new(study.methods, study.methods_of_rows.back());
    add_new(study.targets, study.results.text(row, "target"));
    add_new(study.seeds, study.results.text(row, "seed"));
    add_new(study.objectives, study.results.text(row, "objective"));
  }
  check_finished(study);
  return study;
}

bool is_done(const Study& study, std::size_t row) { return study.results.text(row, "status") == "done"; }

/// The mask that a study's fits of this target saw; empty where no run left it.
std::string mask_of(const Study& study, const std::string& target) {
  std::error_code error;
  for (std::size_t row = 0; row < study.results.rows.size(); ++row) {
    const fs::path mask = run_directory(study.directory, study.results.text(row, "run")) / "target.png";
    if (study.results.text(row, "target") == target && fs::is_regular_file(mask, error))
      return read_file(mask);
  }
  return "";
}

void check_same_masks(const Study& first, const Study& second, const Names& targets) {
  for (const std::string& target : targets) {
    const std::string a = mask_of(first, target), b = mask_of(second, target);
    if (!a.empty() && !b.empty() && a != b)
      throw_input_error(
          "{}: got another mask of target '{}' than in {} (picture, size or view), expected one",
          second.directory.string(), target, first.directory.string());
  }
}

Names common_targets(const Study& first, const Study& second) {
  Names common;
  for (const std::string& target : first.targets)
    if (contains(second.targets, target)) common.push_back(target);
  if (common.empty())
    throw_input_error("{}: got the targets {}, expected at least one of {}: {}", second.directory.string(),
                      fmt::join(second.targets, ", "), first.directory.string(),
                      fmt::join(first.targets, ", "));
  check_same_masks(first, second, common);
  return common;
}

/// Whether every run on these targets that did not fail has it.
bool has_measure(const Study& study, const Names& targets, const std::string& measure) {
  if (!study.results.has(measure)) return false;
  for (std::size_t row = 0; row < study.results.rows.size(); ++row)
    if (is_done(study, row) && contains(targets, study.results.text(row, "target")) &&
        std::isnan(study.results.number(row, measure)))
      return false;
  return true;
}

Names common_measures(const Study& first, const Study& second, const Names& targets) {
  Names measures;
  for (const char* measure : kMeasuresInCommon)
    if (has_measure(first, targets, measure) && has_measure(second, targets, measure))
      measures.emplace_back(measure);
  if (measures.empty())
    throw_input_error("{}: got no measure that {} has too, expected one of {}", second.directory.string(),
                      first.directory.string(), fmt::join(kMeasuresInCommon, ", "));
  return measures;
}

/// Means over the seeds, target by target; a failed run counts as 0.
std::vector<double> target_means(const Study& study, const Names& targets, const std::string& method,
                                 const std::string& measure) {
  std::vector<double> means(targets.size(), 0.0);
  for (std::size_t row = 0; row < study.results.rows.size(); ++row) {
    const auto target = std::ranges::find(targets, study.results.text(row, "target"));
    if (target == targets.end() || study.methods_of_rows[row] != method || !is_done(study, row)) continue;
    means[static_cast<std::size_t>(target - targets.begin())] +=
        study.results.number(row, measure) / static_cast<double>(study.seeds.size());
  }
  return means;
}

double mean_of_all(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Kerby 2014: the share of ranks that favour the second less that of those that favour the first.
double rank_biserial(const SignedRankTest& test) {
  const auto pairs = static_cast<double>(test.pairs);
  return test.pairs == 0 ? 0 : 2 * test.statistic / (pairs * (pairs + 1) / 2) - 1;
}

using MethodPair = std::pair<std::string, std::string>;

std::vector<MethodPair> pairs_of(const Study& first, const Study& second) {
  std::vector<MethodPair> shared, all;
  for (const std::string& a : first.methods)
    for (const std::string& b : second.methods) {
      all.emplace_back(a, b);
      if (a == b) shared.emplace_back(a, b);
    }
  return shared.empty() ? all : shared;
}

/// A row without its corrected p-value, which is appended.
std::vector<std::string> compare_pair(const std::string& measure, const MethodPair& pair,
                                      const std::vector<double>& first, const std::vector<double>& second,
                                      std::vector<double>& p_values) {
  std::vector<double> gains(first.size());
  std::ranges::transform(second, first, gains.begin(), std::minus<>());
  const SignedRankTest test = signed_rank_test(gains);
  const MedianInterval interval = median_interval(gains, kCoverage);
  p_values.push_back(test.p_value);
  return {measure,
          pair.first,
          pair.second,
          fmt::format("{}", gains.size()),
          table_cell(mean_of_all(first)),
          table_cell(mean_of_all(second)),
          table_cell(median(gains)),
          table_cell(interval.lower),
          table_cell(interval.upper),
          table_cell(rank_biserial(test)),
          table_cell(test.p_value)};
}

CsvTable compare_all(const Study& first, const Study& second, const Names& targets, const Names& measures) {
  CsvTable table{{"measure", "first", "second", "targets", "mean_first", "mean_second", "median_difference",
                  "lower_95", "upper_95", "rank_biserial", "p_value", "p_holm"},
                 {},
                 "compare.csv"};
  std::vector<double> p_values;
  for (const std::string& measure : measures)
    for (const MethodPair& pair : pairs_of(first, second))
      table.rows.push_back(compare_pair(measure, pair, target_means(first, targets, pair.first, measure),
                                        target_means(second, targets, pair.second, measure), p_values));
  const std::vector<double> adjusted = holm_adjusted(p_values);
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    table.rows[row].push_back(table_cell(adjusted[row]));
  return table;
}

Names targets_of_one(const Study& first, const Study& second) {
  Names alone;
  for (const Study* study : {&first, &second})
    for (const std::string& target : study->targets)
      if (!contains(first.targets, target) || !contains(second.targets, target)) alone.push_back(target);
  return alone;
}

/// "|" would end a cell.
std::string markdown_cell(const std::string& text) {
  std::string cell;
  for (const char letter : text) {
    if (letter == '|') cell += '\\';
    cell += letter;
  }
  return cell;
}

std::string markdown_row(const Names& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row.append(" ").append(markdown_cell(cell)).append(" |");
  return row.append("\n");
}

}  // namespace

StudyComparison compare_studies(const fs::path& first_directory, const fs::path& second_directory) {
  const Study first = read_study(first_directory), second = read_study(second_directory);
  StudyComparison comparison{first_directory.string(), second_directory.string(), {}, {}, {}, {}, 0, 0, {}};
  comparison.targets = common_targets(first, second);
  comparison.left_out = targets_of_one(first, second);
  comparison.objectives = first.objectives;
  for (const std::string& objective : second.objectives) add_new(comparison.objectives, objective);
  comparison.measures = common_measures(first, second, comparison.targets);
  comparison.first_seeds = first.seeds.size(), comparison.second_seeds = second.seeds.size();
  comparison.table = compare_all(first, second, comparison.targets, comparison.measures);
  return comparison;
}

std::string comparison_as_markdown(const StudyComparison& comparison) {
  const std::size_t targets = comparison.targets.size();
  std::string text = fmt::format(
      "# {} and {}\n\n"
      "Blocks are the {} targets that both have ({}), with means over {} and {} seeds; a failed run counts "
      "as 0.\n",
      comparison.first, comparison.second, targets, fmt::join(comparison.targets, ", "),
      comparison.first_seeds, comparison.second_seeds);
  if (!comparison.left_out.empty())
    text +=
        fmt::format("Left out, since one study alone has them: {}.\n", fmt::join(comparison.left_out, ", "));
  text += fmt::format(
      "Compared by {}, which both have; not by fitness, the objective that was searched for ({}).\n"
      "Differences are the second's less the first's: positive where the second is better. Their median has "
      "its "
      "95 % bootstrap interval;\nthe rank-biserial correlation is 1 where the second is better on every "
      "target. "
      "Wilcoxon's signed-rank test, two-sided, which cannot\nfall below {:.2g} with so many targets; p_holm "
      "is "
      "corrected for all rows of the table (Holm).\n\n",
      fmt::join(comparison.measures, ", "), fmt::join(comparison.objectives, "; "),
      std::min(1.0, std::pow(2.0, 1 - static_cast<double>(targets))));
  text += markdown_row(comparison.table.columns);
  text += markdown_row(Names(comparison.table.columns.size(), "---"));
  for (const Names& row : comparison.table.rows) text += markdown_row(row);
  return text;
}

}  // namespace espalier
