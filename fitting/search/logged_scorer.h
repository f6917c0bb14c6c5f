// The one place that counts, logs, replays and limits the evaluations of a run, and knows its best.
// While the log of an interrupted run lasts, its values are served instead of computed; the optimiser
// cannot tell, so a resumed run is bit for bit the unbroken one. Past the limit candidates are not
// evaluated and get kNotEvaluated: what an optimiser does up to evaluation N never depends on N.
#pragma once
#include <functional>
#include <limits>

#include <espalier/fitting/search/evaluation_log.h>
#include <espalier/fitting/task/scorer.h>

namespace espalier {

/// The score of candidates beyond the limit: finite, worse than any other.
inline constexpr double kNotEvaluated = 1e6;

struct BestCandidate {
  ParameterValues values;
  double score = std::numeric_limits<double>::infinity();
  long evaluation = 0;  ///< counted from 1
};

/// A batch as observers see it.
struct ScoredBatch {
  long first_evaluation = 0;       ///< evaluations before it
  std::span<const double> scores;  ///< of its true evaluations
  double seconds = 0;              ///< since the run began, when it was done
  bool improved = false;
  bool replayed = false;                             ///< all of it came from the log
  std::span<const ParameterValues> candidates = {};  ///< that have these scores
};

class LoggedScorer : public Scorer {
 public:
  /// table: of the candidates. limit: most evaluations, 0 for no limit. seconds: the clock of the run, read
  /// after each batch.
  LoggedScorer(Scorer& inner, const ParameterTable& table, EvaluationLog& log, long limit,
               std::function<double()> seconds, std::function<void(const ScoredBatch&)> on_batch);
  void score(std::span<const ParameterValues> candidates, std::span<double> scores) override;

  long evaluations() const { return evaluations_; }
  bool limit_reached() const { return limit_ > 0 && evaluations_ >= limit_; }
  bool replaying() const { return static_cast<std::size_t>(evaluations_) < log_.logged().size(); }
  const BestCandidate& best() const { return best_; }

 private:
  std::size_t replay(std::span<const ParameterValues> candidates, std::span<double> scores);
  void compute(std::span<const ParameterValues> candidates, std::span<double> scores);
  bool update_best(std::span<const ParameterValues> candidates, std::span<const double> scores);

  Scorer& inner_;
  const ParameterTable& table_;
  EvaluationLog& log_;
  long limit_, evaluations_ = 0;
  std::function<double()> seconds_;
  std::function<void(const ScoredBatch&)> on_batch_;
  BestCandidate best_;
  double batch_seconds_ = 0;
};

}  // namespace espalier
