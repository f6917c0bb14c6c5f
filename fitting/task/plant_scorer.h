// Scores candidates by growing, drawing and comparing them: the mean dissimilarity over all plant seeds
// and views, with what the task takes for a plant as a whole (its depth, its share of wood), in [0, 1]. A
// candidate beyond the growth budget is not grown; it scores 1 + log10(factor by which it exceeds the
// budget), worse than any tree and finite. Parallel over (candidate, seed), reduced in index order: the same
// bits for any number of threads.
#pragma once
#include <exception>
#include <string>
#include <vector>

#include <espalier/fitting/task/fit_task.h>
#include <espalier/fitting/task/scorer.h>
#include <espalier/render/grow_and_draw.h>

namespace espalier {

/// The score of a candidate that the model fails on: worse than all others, and finite.
inline constexpr double kFailedCandidate = 1000;

/// Candidates that failed, and why the first of them did.
struct CandidateFailures {
  long count = 0;
  std::string first;
};

class PlantScorer : public Scorer {
 public:
  /// threads: at least 1. `task` must outlive the scorer.
  PlantScorer(const FitTask& task, int threads);
  void score(std::span<const ParameterValues> candidates, std::span<double> scores) override;

  /// From now on a candidate that the model refuses with an InputError scores kFailedCandidate instead of
  /// throwing: an L-system's expressions may have no value there.
  void score_failures_as_worst() { scores_failures_ = true; }
  const CandidateFailures& failures() const { return failures_; }

 private:
  /// What a thread keeps from one candidate to the next.
  struct Worker {
    std::unique_ptr<SilhouetteRenderer> renderer;
    Plant plant;
    std::vector<Mask> masks, leaves;  ///< of each view; leaves where the task expects some
    std::vector<SilhouetteView> drawn_views;
  };
  void prepare(Worker& worker) const;
  bool note_failure(std::span<const std::exception_ptr> errors);
  double score_one(const ParameterValues& values, Seed seed, Worker& worker) const;

  const FitTask& task_;
  std::vector<Worker> workers_;
  std::vector<double> scores_by_seed_;
  bool scores_failures_ = false;
  CandidateFailures failures_;
};

/// The score of a candidate that exceeds its growth budget `factor` times (> 1).
double over_budget_penalty(double factor);

/// How many times a candidate with this score, above 1, exceeds its budget.
double over_budget_factor(double score);

}  // namespace espalier
