#include <espalier/experiments/runner/unseen_trees.h>
#include <espalier/fitting/starts/start_points.h>
#include <espalier/fitting/task/plant_scorer.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace {

constexpr Seed kFirstUnseenSeed = 1'000'000;  ///< beyond those that a record lists: seed, seed + 1, …

/// Large enough for every bundled species: what a fit is limited to does not matter here.
constexpr GrowthBudget kUnseenBudget{};

}  // namespace

UnseenTrees::UnseenTrees(FitRecord record, int count) : record_(std::move(record)) {
  record_.target_hash.clear();
  task_ = make_task(record_);
  task_.growth.budget = kUnseenBudget;
  task_.plant_seeds.clear();
  for (int i = 0; i < count; ++i)
    task_.plant_seeds.push_back(record_.seed + kFirstUnseenSeed + static_cast<Seed>(i));
}

UnseenScore UnseenTrees::score(const ParameterValues& values) const {
  double dissimilarity = 0;
  PlantScorer(task_, 1).score(std::span(&values, 1), std::span(&dissimilarity, 1));
  const auto renderer = task_.make_renderer();
  return {1 - dissimilarity, mean_metrics(task_, draw_candidate(task_, values, *renderer))["iou"]};
}

ParameterValues UnseenTrees::truth(const std::string& species) const {
  return make_start_points(*task_.model, {.source = StartSource::named, .presets = {species}}, {},
                           kUnseenBudget, target_height_m(record_), task_.plant_seeds.front())
      .front()
      .values;
}

UnseenScore score_truth(FitRecord record, const std::string& species, int count) {
  record.model = load_preset(species).model;
  const UnseenTrees trees(std::move(record), count);
  return trees.score(trees.truth(species));
}

}  // namespace espalier
