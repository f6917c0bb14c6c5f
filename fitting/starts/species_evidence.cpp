#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <espalier/fitting/starts/species_evidence.h>
#include <espalier/fitting/task/record_task.h>

namespace espalier {

namespace {

constexpr double kLeastSd = 0.01;  ///< of a dissimilarity: what another size in pixels changes

/// Silhouettes of trees of the species from the side of the first picture, without what the fit adds to them.
std::vector<Mask> draw_trees(const FitTask& task, const ParameterValues& species,
                             SilhouetteRenderer& renderer) {
  FitTask plain = task;
  plain.growth.prune_to = nullptr;
  plain.growth.train = false;
  plain.views.resize(1, plain.views.front());
  plain.plant_seeds.clear();
  for (int i = 0; i < kTreesOfEvidence; ++i)
    plain.plant_seeds.push_back(task.plant_seeds.front() + static_cast<Seed>(i));
  return draw_candidate(plain, species, renderer, {});
}

struct Moments {
  double mean = 0, variance = 0;
};

Moments moments_of(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  Moments moments;
  for (const double value : values) moments.mean += value / count;
  for (const double value : values)
    moments.variance += (value - moments.mean) * (value - moments.mean) / count;
  return moments;
}

/// Mean dissimilarity of the target and the masks, but for the one with index `left_out`.
double mean_dissimilarity(const MaskObjective& objective, const std::vector<Mask>& masks,
                          const PreparedTarget& target, std::size_t left_out) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    if (i == left_out) continue;
    sum += dissimilarity(objective, masks[i], target);
    count += 1;
  }
  return sum / count;
}

/// Of each tree and the others.
Moments own_dissimilarity(const MaskObjective& objective, const std::vector<Mask>& masks) {
  std::vector<double> values;
  for (std::size_t i = 0; i < masks.size(); ++i)
    values.push_back(mean_dissimilarity(objective, masks, PreparedTarget(masks[i]), i));
  return moments_of(values);
}

/// The bundled species as the kind has them: leafless trees without leaves, palms with fronds.
std::vector<StartPoint> candidates(const FitRecord& record, const FitTask& task, const FitPlan& plan) {
  std::vector<StartPoint> species = presets_as_written(task.model->table(), "auto");
  const std::vector<std::string> palms = task.model->palm_presets();
  std::erase_if(species, [&](const StartPoint& start) {
    const bool is_palm = std::ranges::find(palms, start.name) != palms.end();
    return plan.kind != KindChoice::any && is_palm != (plan.kind == KindChoice::palm);
  });
  for (StartPoint& start : species) {
    prepare_start(*task.model, record.growth, target_height_m(record), task.plant_seeds.front(),
                  start.values);
    if (plan.kind == KindChoice::leafless) take_leaves(task.model->table(), start.values);
  }
  return species;
}

}  // namespace

std::string species_in_words(std::span<const SpeciesEvidence> evidence, double departure) {
  if (evidence.empty()) return "";
  constexpr double kToldProbability = 0.1;
  std::string names;
  for (const SpeciesEvidence& row : evidence)
    if (names.empty() || row.probability >= kToldProbability)
      names += fmt::format("{}{} ({:.0f} %)", names.empty() ? "" : ", ", row.species.name, 100 * row.probability);
  return fmt::format("looks like {}; its parameters are {:.2f} spreads of species from {}", names, departure,
                     evidence.front().species.name);
}

std::vector<double> probabilities_of(std::span<const double> excesses, double sd) {
  std::vector<double> probabilities;
  if (excesses.empty()) return probabilities;
  const double least = std::max(0.0, *std::ranges::min_element(excesses));
  const double variance = sd * sd + least * least;
  double sum = 0;
  for (const double excess : excesses) {
    const double beyond = std::max(0.0, excess);
    probabilities.push_back(std::exp(-0.5 * (beyond * beyond - least * least) / variance));
    sum += probabilities.back();
  }
  for (double& probability : probabilities) probability /= sum;
  return probabilities;
}

std::vector<SpeciesEvidence> species_evidence(const FitRecord& record, const FitTask& task,
                                              const FitPlan& plan) {
  const auto renderer = task.make_renderer();
  std::vector<SpeciesEvidence> found;
  std::vector<double> excesses;
  double variance = 0;
  for (const StartPoint& species : candidates(record, task, plan)) {
    const std::vector<Mask> masks = draw_trees(task, species.values, *renderer);
    if (std::ranges::any_of(masks, [](const Mask& mask) { return area_px(mask) == 0; })) continue;
    const Moments own = own_dissimilarity(task.objective, masks);
    const double of_picture =
        mean_dissimilarity(task.objective, masks, task.views.front().target, masks.size());
    found.push_back({species, of_picture, own.mean});
    excesses.push_back(of_picture - own.mean);
    variance += own.variance;
  }
  const double sd =
      std::max(kLeastSd, std::sqrt(variance / std::max<double>(1, static_cast<double>(found.size()))));
  const std::vector<double> probabilities = probabilities_of(excesses, sd);
  for (std::size_t i = 0; i < found.size(); ++i) found[i].probability = probabilities[i];
  std::ranges::stable_sort(found, std::ranges::greater{}, &SpeciesEvidence::probability);
  return found;
}

}  // namespace espalier
