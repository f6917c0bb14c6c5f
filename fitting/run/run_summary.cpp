#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include <espalier/fitting/run/run_summary.h>
#include <espalier/image/measures/metrics_json.h>

namespace espalier {

namespace {

constexpr std::size_t kShownSpecies = 3;

nlohmann::ordered_json archive_to_json(const SolutionArchive& archive) {
  auto rows = nlohmann::ordered_json::array();
  for (const ArchivedSolution& solution : archive.solutions())
    rows.push_back({{"preset", fmt::format("archive/{}.toml", rows.size() + 1)},
                    {"fitness", 1 - solution.score},
                    {"distance", distance_between(solution, archive.solutions().front())}});
  return rows;
}

/// What the colours of the first picture say, and what is expected where they say nothing.
nlohmann::ordered_json labels_to_json(const PlantLabels& labels, KindChoice kind) {
  const char* in_doubt = kind == KindChoice::leafy ? "leaves in the crown, as a leafy tree has them"
                                                   : "wood or leaves, as the model grows them";
  if (labels.how.empty()) return {{"how", "not looked for"}, {"in_doubt", in_doubt}};
  return {
      {"leaf", labels.leaf_share}, {"wood", labels.wood_share}, {"how", labels.how}, {"in_doubt", in_doubt}};
}

nlohmann::ordered_json portrait_to_json(const PlantPortrait& portrait) {
  nlohmann::ordered_json json;
  for (const PlantMeasure& measure : kPlantMeasures) {
    const double value = portrait.*measure.value;
    if (measure.counts)
      json[measure.name] = std::lround(value);
    else
      json[measure.name] = value;
  }
  return json;
}

nlohmann::ordered_json resemblances_to_json(const std::vector<Resemblance>& resemblances) {
  auto rows = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < std::min(kShownSpecies, resemblances.size()); ++i)
    rows.push_back({{"species", resemblances[i].species}, {"departure", resemblances[i].departure}});
  return rows;
}

}  // namespace

std::string run_summary(const RunState& state) {
  nlohmann::ordered_json summary;
  summary["fitness"] = 1 - state.best.score;
  summary.update(nlohmann::ordered_json(state.best_metrics));
  summary["evaluations"] = state.evaluations;
  summary["branch_rounds"] = state.branches.rounds;
  summary["branch_steps"] = state.branches.steps;
  summary["kind"] = name_of(state.kind);
  summary["trained_to_target"] = state.task.growth.train;
  if (state.metrics_untrained) summary["without_training"] = *state.metrics_untrained;
  if (state.full_size) {
    summary["full_size"] = state.full_size->metrics;
    summary["full_size"]["size_px"] = state.full_size->best.front().width_px();
  }
  summary["labels"] = labels_to_json(state.task.views.front().labels, state.kind);
  if (state.portrait) summary["plant"] = portrait_to_json(*state.portrait);
  if (!state.resemblances.empty()) summary["resembles"] = resemblances_to_json(state.resemblances);
  summary["best_at_evaluation"] = state.best.evaluation;
  summary["seconds"] = state.seconds;
  summary["evaluations_per_second"] =
      state.seconds > 0 ? static_cast<double>(state.evaluations) / state.seconds : 0;
  summary["stopped_by"] = state.stopped_by ? name_of(*state.stopped_by) : "still running, or killed";
  summary["optimizer"] = state.record.optimizer;
  summary["objective"] = state.record.objective;
  summary["model"] = state.record.model;
  summary["seed"] = state.record.seed;
  summary["fit_seeds"] = state.record.fit_seeds;
  summary["size_px"] = state.record.target.size_px;
  summary["embree_disagreement_pixels"] = state.embree_disagreement_px;
  if (state.failures.count > 0)
    summary["failed_candidates"] = {{"count", state.failures.count}, {"first", state.failures.first}};
  if (state.record.height_m) summary["height_m"] = *state.record.height_m;
  for (const ViewRecord& view : state.record.views) summary["pictures"].push_back(view.picture.string());
  for (const TargetView& view : state.task.views) summary["confidence"].push_back(view.confidence);
  if (!state.task.warnings.empty()) summary["warnings"] = state.task.warnings;
  if (state.archive) {
    for (const FreeParameter& parameter : state.archive->space().free)
      summary["searched"].push_back(parameter.name);
    summary["archive"] = archive_to_json(*state.archive);
  }
  for (const ScoredStart& start : state.starts)
    summary["starts"].push_back({{"name", start.name}, {"fitness", start.fitness}});
  return summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace espalier
