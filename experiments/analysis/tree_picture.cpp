#include <espalier/core/error.h>
#include <espalier/experiments/analysis/tree_picture.h>
#include <espalier/fitting/record/fit_record.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/render/shading/shaded.h>

namespace espalier {

Picture draw_fitted_tree(const std::filesystem::path& run_directory, int size_px) {
  const Preset preset = load_preset((run_directory / "best.toml").string());
  const FitRecord record = read_record(run_directory / "run.toml").record;
  const std::unique_ptr<Volume> envelope = envelope_of(preset.grown_into);
  const ChangeGraph changes(preset.overrides);
  const GrowthSettings settings{.prune_to = envelope.get(), .train = true, .changes = &changes};
  Plant plant;
  if (!model_by_name(preset.model).generate(preset.values, record.seed, settings, plant).grown)
    throw_input_error("{}: got a tree beyond the growth budget, expected a smaller one",
                      (run_directory / "best.toml").string());
  const View aside{.azimuth_deg = 45, .elevation_deg = 15};
  return render_shaded(plant, frame_bounds(bounds(plant), aside, size_px, size_px), {.samples_per_px = 16});
}

}  // namespace espalier
