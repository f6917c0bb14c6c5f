#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <espalier/fitting/search/trace.h>

namespace espalier {

namespace {

constexpr std::size_t kMostChartDots = 400;

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A cell and a comma a measure; the cell of an unknown one is empty.
std::string metric_cells(const MaskMetrics& metrics) {
  std::string cells;
  for (const double value : metrics.values) cells += std::isnan(value) ? "," : fmt::format("{:.6f},", value);
  return cells;
}

/// Where a row is on the axis of the chart.
double place_of(const TraceRow& row) { return static_cast<double>(row.evaluations + row.branch_steps); }

const char* end_of(FitStage stage) {
  switch (stage) {
    case FitStage::starts:
      return "starts end";
    case FitStage::species_space:
    case FitStage::search:
      return "search ends";
    case FitStage::tracing:
    case FitStage::branches:
    case FitStage::finish:
      return "refinement ends";
  }
  return "";
}

/// The last row of each: what follows has another end.
std::vector<ChartMark> ends_of_stages(const std::vector<TraceRow>& rows) {
  std::vector<ChartMark> marks;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string end = end_of(rows[i].stage);
    if (i + 1 == rows.size() || end != end_of(rows[i + 1].stage)) marks.push_back({end, place_of(rows[i])});
  }
  return marks;
}

}  // namespace

void Trace::add(const ScoredBatch& batch, double best_score, const MaskMetrics& best_metrics,
                FitStage stage) {
  pending_scores_.insert(pending_scores_.end(), batch.scores.begin(), batch.scores.end());
  const bool whole_row =
      batch.improved || batch.scores.size() > 1 || pending_scores_.size() >= kRowEvaluations;
  if (!whole_row) return;
  const auto [least, most] = std::minmax_element(pending_scores_.begin(), pending_scores_.end());
  rows_.push_back({.evaluations = batch.first_evaluation + static_cast<long>(batch.scores.size()),
                   .seconds = batch.seconds,
                   .improved = batch.improved,
                   .best = 1 - best_score,
                   .batch_best = 1 - *least,
                   .batch_median = 1 - median_of(pending_scores_),
                   .batch_worst = 1 - *most,
                   .metrics = best_metrics,
                   .stage = stage});
  pending_scores_.clear();
}

void Trace::add_round(long evaluations, long branch_steps, double seconds, bool improved, double best_score,
                      const MaskMetrics& best_metrics, FitStage stage) {
  const double fitness = 1 - best_score;
  rows_.push_back({.evaluations = evaluations,
                   .branch_steps = branch_steps,
                   .seconds = seconds,
                   .improved = improved,
                   .best = fitness,
                   .batch_best = fitness,
                   .batch_median = fitness,
                   .batch_worst = fitness,
                   .metrics = best_metrics,
                   .stage = stage});
}

std::string trace_to_csv(const std::vector<TraceRow>& rows) {
  std::string csv = "evaluations,seconds,branch_steps,event,best,batch_best,batch_median,batch_worst,";
  for (const Metric& metric : kMetrics) csv += fmt::format("{},", metric.name);
  csv += "stage\n";
  for (const TraceRow& row : rows)
    csv += fmt::format("{},{:.3f},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{}{}\n", row.evaluations, row.seconds,
                       row.branch_steps, row.improved ? "improvement" : "batch", row.best, row.batch_best,
                       row.batch_median, row.batch_worst, metric_cells(row.metrics), name_of(row.stage));
  return csv;
}

std::string fitness_in_words(const MaskObjective& objective, const std::string& less) {
  constexpr std::size_t kMostLetters = 40;  // as many as fit beside the axis
  std::vector<std::string> parts;
  parts.reserve(objective.terms.size() + 1);
  for (const ObjectiveTerm& term : objective.terms)
    parts.push_back((parts.empty() ? "" : "+ ") + (objective.terms.size() == 1
                                                       ? term.name
                                                       : fmt::format("{:.3g} {}", term.weight, term.name)));
  if (!less.empty()) parts.push_back("less " + less);
  std::string text = "fitness by";
  std::size_t line_from = 0;
  for (const std::string& part : parts) {
    const bool fits = text.size() - line_from + 1 + part.size() <= kMostLetters;
    if (!fits) line_from = text.size() + 1;
    text += (fits ? " " : "\n") + part;
  }
  return text;
}

LineChart convergence_chart(const std::vector<TraceRow>& rows, const std::string& fitness) {
  ChartLine best{"best so far", {0, 114, 178}, 3, false, {}};
  ChartLine median{"median of the batch", {230, 159, 0}, 5, true, {}};
  const std::size_t stride = rows.size() / kMostChartDots + 1;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double place = place_of(rows[i]);
    if (rows[i].improved || i + 1 == rows.size()) {
      if (!best.points.empty()) best.points.emplace_back(place, best.points.back().second);  // a step
      best.points.emplace_back(place, rows[i].best);
    }
    if (i % stride == 0 && rows[i].batch_median >= 0) median.points.emplace_back(place, rows[i].batch_median);
  }
  const bool is_refined = !rows.empty() && rows.back().branch_steps > 0;
  LineChart chart{is_refined ? "evaluations, then branch steps" : "evaluations", fitness, {median, best}};
  chart.marks = ends_of_stages(rows);
  return chart;
}

}  // namespace espalier
