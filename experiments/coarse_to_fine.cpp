// Does a search that begins with smaller masks end better? For each picture (or preset, by name) and seed,
// CMA-ES searches with each schedule of mask sizes at the same cost. Prints the best fitness at full detail:
// only what the last stage evaluates counts (docs/levels_of_detail.md).
//   build/bin/coarse_to_fine targets/fir.png quaking_aspen …
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>

#include <espalier/core/error.h>
#include <espalier/fitting/search/fit_objective.h>
#include <espalier/fitting/task/plant_scorer.h>

#include "measured_target.h"

namespace espalier {
namespace {

constexpr int kThreads = 2, kSeeds = 3;

struct Stage {
  int size_px;
  double cost;   ///< of an evaluation, in evaluations at full detail
  double share;  ///< of the cost of the search
};

struct Schedule {
  const char* name;
  double evaluations;  ///< at full detail that cost as much as the search
  std::vector<Stage> stages;
};

// Near the costs measured in docs/levels_of_detail.md; at 128² in favour of the smaller masks.
const Schedule kSchedules[] = {
    {"128", 6000, {{128, 1, 1}}},
    {"96 to 128", 6000, {{96, 0.85, 0.5}, {128, 1, 0.5}}},
    {"64 to 128", 6000, {{64, 0.75, 0.5}, {128, 1, 0.5}}},
    {"512", 2000, {{512, 1, 1}}},
    {"256 to 512", 2000, {{256, 0.5, 0.5}, {512, 1, 0.5}}},
    {"128 to 512", 2000, {{128, 0.34, 0.5}, {512, 1, 0.5}}},
};

/// Scores with one stage after the other; a batch belongs to the stage in which it begins.
class StagedScorer : public Scorer {
 public:
  StagedScorer(const MeasuredTarget& target, const Schedule& schedule) {
    for (const Stage& stage : schedule.stages) {
      end_ += static_cast<long>(schedule.evaluations * stage.share / stage.cost);
      stages_.push_back({std::make_unique<FitTask>(target.task(stage.size_px)), nullptr, end_});
      stages_.back().scorer = std::make_unique<PlantScorer>(*stages_.back().task, kThreads);
    }
  }
  void score(std::span<const ParameterValues> candidates, std::span<double> scores) override {
    const auto running = std::find_if(stages_.begin(), stages_.end() - 1,
                                      [&](const RunningStage& stage) { return evaluations_ < stage.end; });
    running->scorer->score(candidates, scores);
    evaluations_ += static_cast<long>(candidates.size());
    if (running == stages_.end() - 1)
      best_ = std::min(best_, *std::min_element(scores.begin(), scores.end()));
  }
  long end() const { return end_; }
  double best() const { return best_; }  ///< at full detail

 private:
  struct RunningStage {
    std::unique_ptr<FitTask> task;
    std::unique_ptr<PlantScorer> scorer;
    long end;
  };
  std::vector<RunningStage> stages_;
  long end_ = 0, evaluations_ = 0;
  double best_ = std::numeric_limits<double>::infinity();
};

SearchBeginning begin_at_full_detail(const MeasuredTarget& target, const Schedule& schedule) {
  const FitTask full = target.task(schedule.stages.back().size_px);
  PlantScorer scorer(full, kThreads);
  return begin_search(full, scorer);
}

double best_fitness(const MeasuredTarget& target, const SearchBeginning& beginning, const Schedule& schedule,
                    Seed seed) {
  StagedScorer scorer(target, schedule);
  Observer observer;
  optimizer_by_name("cma_es").minimize(FitObjective(beginning.space, scorer), {}, {scorer.end()},
                                       beginning.points(), seed, observer);
  return 1 - scorer.best();
}

void measure(const MeasuredTarget& target) {
  std::vector<SearchBeginning> beginnings;
  for (const Schedule& schedule : kSchedules) beginnings.push_back(begin_at_full_detail(target, schedule));
  for (Seed seed = 1; seed <= kSeeds; ++seed) {
    fmt::print("{},{}", target.name(), seed);
    for (std::size_t i = 0; i < beginnings.size(); ++i)
      fmt::print(",{:.4f}", best_fitness(target, beginnings[i], kSchedules[i], seed));
    fmt::print("\n");
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace espalier

int main(int argc, char** argv) {
  using namespace espalier;
  std::string head = "target,seed";
  for (const Schedule& schedule : kSchedules) head += fmt::format(",{}", schedule.name);
  return measure_targets(argc, argv, head, measure);
}
