// The history of a run: one row per improvement and per batch (a generation of a population method).
// Methods that evaluate one candidate at a time get a row every kRowEvaluations. Fitness is
// 1 - dissimilarity; it is negative for candidates beyond the growth budget.
#pragma once
#include <string>
#include <vector>

#include <espalier/charts/line_chart.h>
#include <espalier/fitting/record/fit_stages.h>
#include <espalier/fitting/search/logged_scorer.h>
#include <espalier/image/measures/metric_table.h>
#include <espalier/image/measures/objective.h>

namespace espalier {

inline constexpr std::size_t kRowEvaluations = 20;

struct TraceRow {
  long evaluations = 0;   ///< of starts and searches
  long branch_steps = 0;  ///< of the refinement, which evaluates nothing but branches
  double seconds = 0;
  bool improved = false;
  double best = 0;                                           ///< fitness of the run so far
  double batch_best = 0, batch_median = 0, batch_worst = 0;  ///< fitness since the row before
  MaskMetrics metrics;                                       ///< of the best so far
  FitStage stage = FitStage::search;
};

class Trace {
 public:
  /// best_metrics: of the best candidate after this batch, whose score is `best_score`. stage: of the run.
  void add(const ScoredBatch& batch, double best_score, const MaskMetrics& best_metrics,
           FitStage stage = FitStage::search);
  /// A row of a stage whose evaluations are not scored in batches.
  void add_round(long evaluations, long branch_steps, double seconds, bool improved, double best_score,
                 const MaskMetrics& best_metrics, FitStage stage);
  const std::vector<TraceRow>& rows() const { return rows_; }

 private:
  std::vector<TraceRow> rows_;
  std::vector<double> pending_scores_;
};

std::string trace_to_csv(const std::vector<TraceRow>& rows);

/// What fitness is made of: "fitness by 0.5 iou + 0.5 gap_iou less prices", in lines for an axis. less: what
/// is taken from it besides, in words, or empty.
std::string fitness_in_words(const MaskObjective& objective, const std::string& less);

/// Fitness over evaluations and, after them, steps of the refinement: the best so far, and the median of each
/// batch. Marked is where starts, search and refinement end.
LineChart convergence_chart(const std::vector<TraceRow>& rows, const std::string& fitness);

}  // namespace espalier
