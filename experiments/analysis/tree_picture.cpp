#include <espalier/experiments/analysis/tree_picture.h>
#include <espalier/fitting/record/fit_record.h>
#include <espalier/models/grow_preset.h>
#include <espalier/render/shading/shaded.h>

namespace espalier {

Picture draw_fitted_tree(const std::filesystem::path& run_directory, int size_px) {
  const std::string file = (run_directory / "best.toml").string();
  Preset preset = load_preset(file);
  // Presets of versions before 0.2 do not name their seed.
  if (!preset.seed) preset.seed = read_record(run_directory / "run.toml").record.seed;
  const Plant plant = grow_preset(preset, file);
  const View aside{.azimuth_deg = 45, .elevation_deg = 15};
  return render_shaded(plant, frame_bounds(bounds(plant), aside, size_px, size_px), {.samples_per_px = 16});
}

}  // namespace espalier
