#include <algorithm>

#include <espalier/core/error.h>
#include <espalier/fitting/search/logged_scorer.h>

namespace espalier {

LoggedScorer::LoggedScorer(Scorer& inner, const ParameterTable& table, EvaluationLog& log, long limit,
                           std::function<double()> seconds, std::function<void(const ScoredBatch&)> on_batch)
    : inner_(inner),
      table_(table),
      log_(log),
      limit_(limit),
      seconds_(std::move(seconds)),
      on_batch_(std::move(on_batch)) {}

void LoggedScorer::score(std::span<const ParameterValues> candidates, std::span<double> scores) {
  ESPALIER_CHECK_EQ(scores.size(), candidates.size());
  const std::size_t allowed =
      limit_ > 0 ? std::min(candidates.size(), static_cast<std::size_t>(limit_ - evaluations_))
                 : candidates.size();
  std::fill(scores.begin() + static_cast<std::ptrdiff_t>(allowed), scores.end(), kNotEvaluated);
  if (allowed == 0) return;
  const std::span<const ParameterValues> evaluated = candidates.first(allowed);
  const std::size_t replayed = replay(evaluated, scores.first(allowed));
  if (replayed < allowed) compute(evaluated.subspan(replayed), scores.subspan(replayed, allowed - replayed));
  const bool improved = update_best(evaluated, scores.first(allowed));
  evaluations_ += static_cast<long>(allowed);
  on_batch_({evaluations_ - static_cast<long>(allowed), scores.first(allowed), batch_seconds_, improved,
             replayed == allowed, evaluated});
}

std::size_t LoggedScorer::replay(std::span<const ParameterValues> candidates, std::span<double> scores) {
  const std::vector<LoggedEvaluation>& logged = log_.logged();
  const auto first = static_cast<std::size_t>(evaluations_);
  const std::size_t count = first < logged.size() ? std::min(candidates.size(), logged.size() - first) : 0;
  for (std::size_t i = 0; i < count; ++i) {
    const LoggedEvaluation& entry = logged[first + i];
    if (entry.candidate_hash != hash_values(table_, candidates[i]))
      throw_input_error(
          "evaluations.bin: evaluation {} differs from the one in the log, expected the same program, "
          "libraries and presets as in the run that began",
          first + i + 1);
    scores[i] = entry.value;
    batch_seconds_ = entry.seconds;
  }
  return count;
}

void LoggedScorer::compute(std::span<const ParameterValues> candidates, std::span<double> scores) {
  inner_.score(candidates, scores);
  batch_seconds_ = seconds_();
  std::vector<LoggedEvaluation> entries;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    entries.push_back({scores[i], static_cast<float>(batch_seconds_), hash_values(table_, candidates[i])});
  log_.append(entries);
}

bool LoggedScorer::update_best(std::span<const ParameterValues> candidates, std::span<const double> scores) {
  bool improved = false;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (!(scores[i] < best_.score)) continue;
    best_ = {candidates[i], scores[i], evaluations_ + static_cast<long>(i) + 1};
    improved = true;
  }
  return improved;
}

}  // namespace espalier
