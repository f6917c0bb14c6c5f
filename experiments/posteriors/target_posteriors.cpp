#include <fmt/format.h>

#include <algorithm>
#include <map>

#include <espalier/core/files.h>
#include <espalier/experiments/posteriors/target_posteriors.h>
#include <espalier/fitting/posterior/simulations/plant_quantities.h>
#include <espalier/fitting/posterior/simulations/plant_simulator.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/plant/plant.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

/// Values by the names of unknowns: those parameters and quantities that the tree has.
std::map<std::string, double> true_values(const TrueTree& tree, double height_m) {
  const Preset preset = load_preset(tree.species);
  const Model& model = model_by_name(preset.model);
  std::map<std::string, double> truth;
  if (model.table().model == PosteriorRequest{}.model)
    for (std::size_t row = 0; row < preset.values.size(); ++row)
      truth[model.table().rows[row].full_name()] = preset.values[row];
  Plant plant;
  if (!model.generate(preset.values, tree.seed, {}, plant).grown) return truth;
  const Bounds box = bounds(plant);
  const auto lowest_m = std::min(0.0, static_cast<double>(box.lower.z)),
             tall_m = static_cast<double>(box.upper.z) - lowest_m;
  const std::vector<double> quantities = quantities_of(plant, lowest_m, tall_m, height_m);
  for (std::size_t i = 0; i < quantities.size(); ++i) truth[kPlantQuantities[i].name] = quantities[i];
  return truth;
}

std::string rows_of(const PosteriorTarget& target, const PosteriorResult& result) {
  const std::map<std::string, double> truth =
      target.truth ? true_values(*target.truth, target.height_m) : std::map<std::string, double>{};
  std::string rows;
  for (const UnknownSummary& row : result.unknowns) {
    const auto [lower, upper] = row.intervals.back();
    const auto known = truth.find(row.unknown.name);
    const std::string true_cells =
        known == truth.end() ? ","
                             : fmt::format("{:.6g},{}", known->second,
                                           lower <= known->second && known->second <= upper ? 1 : 0);
    rows += fmt::format("\"{}\",{},{},{:.6g},{:.6g},{:.6g},{:.4f},{},{:.4f},{}\n", target.name,
                        row.unknown.name, row.unknown.unit, row.median, lower, upper, row.width_share,
                        name_of(row.determination), result.check.tail_share, true_cells);
  }
  return rows;
}

}  // namespace

void write_target_posteriors(const fs::path& directory, const std::vector<PosteriorTarget>& targets,
                             const TargetPosteriorOptions& options) {
  std::string csv =
      "target,unknown,unit,median,lower_90,upper_90,width_share,determination,tail_share,truth,holds_truth\n";
  const fs::path folder = directory / "posteriors";
  fs::create_directories(folder);
  for (const PosteriorTarget& target : targets) {
    const PosteriorRequest request{.picture = target.picture.filename().string(),
                                   .height_m = target.height_m,
                                   .simulations = options.simulations,
                                   .table = folder / fmt::format("plants_{:g}.bin", target.height_m),
                                   .version = options.version,
                                   .training = options.training};
    const TargetPicture picture = read_mask(target.picture, options.reading);
    const PosteriorResult result = compute_posterior(
        request, picture.mask, folder / target.directory, options.threads,
        [&](std::size_t done, std::size_t wanted) { return options.on_progress(target.name, done, wanted); });
    if (!result.is_complete()) return;
    csv += rows_of(target, result);
  }
  write_file_atomically(directory / "posteriors.csv", csv);
}

}  // namespace espalier
