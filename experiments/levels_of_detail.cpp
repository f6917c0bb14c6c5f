// Which cheaper scores rank candidates like the full one: smaller masks, fewer but larger leaves
// (docs/levels_of_detail.md). For each picture (or preset, by name) it collects 300 candidates: 100 start
// points with noise, 100 of a whole search and 100 of its last third; scores them at each level; and prints
// Spearman's rho with the score at 512² with all leaves, and the time of an evaluation, on one thread.
//   build/bin/levels_of_detail targets/fir.png quaking_aspen …
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/experiments/statistics/rank_correlation.h>
#include <espalier/fitting/optimizers/random_stream.h>
#include <espalier/fitting/search/fit_objective.h>
#include <espalier/fitting/task/plant_scorer.h>

#include "measured_target.h"

namespace espalier {
namespace {

using Clock = std::chrono::steady_clock;
using Candidates = std::vector<ParameterValues>;

constexpr int kFullSizePx = 512, kSearchSizePx = 128;
constexpr int kSizesPx[] = {48, 64, 96, 128, 192, 256, 512};

/// How leaves are thinned: by the model's parameters (they then grow elsewhere, and growth is cheaper), or by
/// keeping each k-th leaf of the grown plant (the same leaves, but all of them are grown).
enum class Thinning { none, parameters, kept };
constexpr const char* kThinningNames[] = {"none", "parameters", "kept"};

struct Level {
  int size_px;
  Thinning thinning;
  int leaves_per_kept;
};

constexpr std::size_t kOfEachKind = 100;
constexpr long kSearchEvaluations = 3000;
constexpr double kNoise = 0.1;  ///< standard deviation around start points, of the width of the search space
constexpr const char* kKinds[] = {"noisy starts", "whole search", "last third"};

/// Remembers what it scores, but for candidates beyond the growth budget: any level ranks those last.
class RememberingScorer : public Scorer {
 public:
  explicit RememberingScorer(Scorer& inner) : inner_(inner) {}
  void score(std::span<const ParameterValues> candidates, std::span<double> scores) override {
    inner_.score(candidates, scores);
    for (std::size_t i = 0; i < scores.size(); ++i)
      if (scores[i] <= 1) grown.push_back(candidates[i]);
  }
  Candidates grown;

 private:
  Scorer& inner_;
};

/// `kOfEachKind` of the candidates from `first` on, evenly spaced.
Candidates spread(const Candidates& all, std::size_t first) {
  Candidates some;
  const std::size_t count = std::min(kOfEachKind, all.size() - first);
  for (std::size_t i = 0; i < count; ++i) some.push_back(all[first + i * (all.size() - first) / count]);
  return some;
}

/// Start points with noise, at most a few thousand tried for those that grow.
Candidates noisy_starts(const SearchBeginning& beginning, Scorer& scorer) {
  const std::vector<StartPoint>& starts = beginning.starts;
  RememberingScorer remembering(scorer);
  for (std::uint64_t tried = 0; tried < 3000 && remembering.grown.size() < kOfEachKind; ++tried) {
    RandomStream draws = random_stream_at(root_key(1), 0, tried);
    std::vector<double> point = beginning.space.encode(starts[draws.below(starts.size())].values);
    for (double& unit : point) unit = std::clamp(unit + kNoise * draws.normal(), 0.0, 1.0);
    ParameterValues values;
    beginning.space.decode(point, values);
    double score = 0;
    remembering.score({&values, 1}, {&score, 1});
  }
  return remembering.grown;
}

/// What CMA-ES evaluates.
Candidates searched(const SearchBeginning& beginning, Scorer& scorer) {
  RememberingScorer remembering(scorer);
  Observer observer;
  optimizer_by_name("cma_es").minimize(FitObjective(beginning.space, remembering), {}, {kSearchEvaluations},
                                       beginning.points(), 1, observer);
  return remembering.grown;
}

/// The candidates in the order of kKinds.
std::vector<Candidates> collect(const MeasuredTarget& target) {
  const FitTask task = target.task(kSearchSizePx);
  PlantScorer scorer(task, 1);
  const SearchBeginning beginning = begin_search(task, scorer);
  const Candidates search = searched(beginning, scorer);
  return {noisy_starts(beginning, scorer), spread(search, 0), spread(search, search.size() * 2 / 3)};
}

/// One leaf for `per_kept`, as much larger that the area stays.
Candidates with_fewer_leaves(Candidates candidates, int per_kept) {
  const std::size_t count = *measured_model().table().find(Role::leaf_count),
                    scale = *measured_model().table().find(Role::leaf_length);
  for (ParameterValues& values : candidates) {
    values[count] /= per_kept;
    values[scale] *= std::sqrt(per_kept);
  }
  return candidates;
}

/// Keeps leaves 0, k, 2k, …, as much larger that the area stays.
void keep_each(int k, Leaves& leaves) {
  const auto factor = static_cast<float>(std::sqrt(k));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < leaves.size(); i += static_cast<std::size_t>(k), ++kept) {
    leaves.position_m[kept] = leaves.position_m[i];
    leaves.axis[kept] = leaves.axis[i];
    leaves.side[kept] = leaves.side[i];
    leaves.length_m[kept] = leaves.length_m[i] * factor;
    leaves.width_m[kept] = leaves.width_m[i] * factor;
    leaves.kind[kept] = leaves.kind[i];
  }
  leaves.position_m.resize(kept), leaves.axis.resize(kept), leaves.side.resize(kept);
  leaves.length_m.resize(kept), leaves.width_m.resize(kept), leaves.kind.resize(kept);
}

/// The model, each k-th leaf of whose plants is kept.
class ModelWithKeptLeaves : public Model {
 public:
  explicit ModelWithKeptLeaves(int k) : k_(k) {}
  const ParameterTable& table() const override { return measured_model().table(); }
  GrowthEstimate estimate(std::span<const double> values) const override {
    return measured_model().estimate(values);
  }
  GrowthResult generate(std::span<const double> values, Seed seed, const GrowthSettings& settings,
                        Plant& plant) const override {
    const GrowthResult result = measured_model().generate(values, seed, settings, plant);
    keep_each(k_, plant.leaves);
    return result;
  }

 private:
  int k_;
};

struct LevelScores {
  std::vector<std::vector<double>> by_kind;
  double ms = 0;  ///< of an evaluation, on one thread
};

LevelScores score_level(const MeasuredTarget& target, const Level& level,
                        const std::vector<Candidates>& by_kind) {
  FitTask task = target.task(level.size_px);
  const ModelWithKeptLeaves kept_leaves(level.leaves_per_kept);
  if (level.thinning == Thinning::kept) task.model = &kept_leaves;
  PlantScorer scorer(task, 1);
  LevelScores scores;
  std::size_t count = 0;
  for (const Candidates& candidates : by_kind) {
    const Candidates thinned = level.thinning == Thinning::parameters
                                   ? with_fewer_leaves(candidates, level.leaves_per_kept)
                                   : candidates;
    scores.by_kind.emplace_back(candidates.size());
    const auto began = Clock::now();
    scorer.score(thinned, scores.by_kind.back());
    scores.ms += std::chrono::duration<double, std::milli>(Clock::now() - began).count();
    count += candidates.size();
  }
  scores.ms /= static_cast<double>(count);
  return scores;
}

std::vector<Level> all_levels() {
  std::vector<Level> levels;
  for (const int size_px : kSizesPx) {
    levels.push_back({size_px, Thinning::none, 1});
    for (const Thinning thinning : {Thinning::parameters, Thinning::kept})
      for (const int k : {2, 4, 8}) levels.push_back({size_px, thinning, k});
  }
  return levels;
}

void measure(const MeasuredTarget& target) {
  const std::vector<Candidates> candidates = collect(target);
  const LevelScores full = score_level(target, {kFullSizePx, Thinning::none, 1}, candidates);
  for (const Level& level : all_levels()) {
    const LevelScores scores = score_level(target, level, candidates);
    fmt::print("{},{},{},{},{:.4f}", target.name(), level.size_px,
               kThinningNames[static_cast<int>(level.thinning)], level.leaves_per_kept, scores.ms);
    for (std::size_t kind = 0; kind < candidates.size(); ++kind)
      fmt::print(",{:.4f}", spearman_rho(full.by_kind[kind], scores.by_kind[kind]));
    fmt::print("\n");
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace espalier

int main(int argc, char** argv) {
  using namespace espalier;
  return measure_targets(argc, argv,
                         fmt::format("target,size_px,thinning,leaves_per_kept,ms,{}", fmt::join(kKinds, ",")),
                         measure);
}
