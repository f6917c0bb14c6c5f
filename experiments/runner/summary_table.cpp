#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

#include <espalier/experiments/runner/summary_table.h>
#include <espalier/experiments/statistics/quantiles.h>

namespace espalier {

namespace {

constexpr std::size_t kMostLines = 40;
using Lines = std::vector<std::vector<std::string>>;  ///< cells of each line

std::string find(const Row& row, const std::string& column) {
  for (const auto& [name, text] : row)
    if (name == column) return text;
  return "";
}

std::string aligned(const Lines& lines) {
  std::vector<std::size_t> widths;
  for (const auto& line : lines) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i)
      text += fmt::format("{:<{}}{}", line[i], widths[i], i + 1 < line.size() ? "  " : "");
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  return text;
}

/// Columns worth a terminal's width: of fits, the measures that everybody compares.
std::vector<std::string> shown_columns(const Plan& plan) {
  std::vector<std::string> shown;
  for (const char* column : {"fitness", "iou", "tolerant_iou", "outline_iou", "pixel_accuracy",
                             "unseen_fitness", "stems", "knots", "leaves", "evaluations", "branch_steps"})
    if (std::find(plan.result_columns.begin(), plan.result_columns.end(), column) !=
        plan.result_columns.end())
      shown.push_back(column);
  return shown;
}

/// Counts stand in the table of times too.
bool is_result(const Plan& plan, const std::string& column) {
  return std::find(plan.result_columns.begin(), plan.result_columns.end(), column) !=
         plan.result_columns.end();
}

std::vector<std::string> cells_of(const RunRow& row, const Plan& plan) {
  std::vector<std::string> cells{row.run, row.status};
  if (row.status == "failed") {
    cells.push_back(row.error);
    return cells;
  }
  for (const std::string& column : shown_columns(plan)) cells.push_back(find(row.measured.results, column));
  for (const std::string& column : plan.time_columns)
    if (!is_result(plan, column)) cells.push_back(find(row.measured.times, column));
  return cells;
}

Lines lines_of_runs(const ExperimentOutcome& outcome) {
  Lines lines{{"run", "status"}};
  for (const std::string& column : shown_columns(outcome.plan)) lines[0].push_back(column);
  for (const std::string& column : outcome.plan.time_columns)
    if (!is_result(outcome.plan, column)) lines[0].push_back(column);
  for (const RunRow& row : outcome.rows) lines.push_back(cells_of(row, outcome.plan));
  return lines;
}

double number(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

Lines lines_of_optimizers(const ExperimentOutcome& outcome) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<double>> fitness, seconds;
  for (const RunRow& row : outcome.rows) {
    const std::string optimizer = find(row.labels, "optimizer");
    if (std::find(order.begin(), order.end(), optimizer) == order.end()) order.push_back(optimizer);
    if (row.status != "done") continue;
    fitness[optimizer].push_back(number(find(row.measured.results, "fitness")));
    seconds[optimizer].push_back(number(find(row.measured.times, "seconds")));
  }
  Lines lines{{"optimizer", "runs", "median fitness", "median seconds"}};
  for (const std::string& optimizer : order)
    lines.push_back({optimizer, fmt::format("{}", fitness[optimizer].size()),
                     fitness[optimizer].empty() ? "" : fmt::format("{:.4f}", median(fitness[optimizer])),
                     seconds[optimizer].empty() ? "" : fmt::format("{:.1f}", median(seconds[optimizer]))});
  for (const RunRow& row : outcome.rows)
    if (row.status == "failed") lines.push_back({row.run, "failed", row.error});
  return lines;
}

}  // namespace

std::string summary_table(const ExperimentOutcome& outcome) {
  const auto& columns = outcome.plan.label_columns;
  const bool are_fits = std::find(columns.begin(), columns.end(), "optimizer") != columns.end();
  return aligned(are_fits && outcome.rows.size() > kMostLines ? lines_of_optimizers(outcome)
                                                              : lines_of_runs(outcome));
}

}  // namespace espalier
