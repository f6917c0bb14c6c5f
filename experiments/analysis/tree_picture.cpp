#include <espalier/charts/chart_layout.h>
#include <espalier/experiments/analysis/tree_picture.h>
#include <espalier/fitting/record/fit_record.h>
#include <espalier/models/grow_preset.h>
#include <espalier/render/shading/shaded.h>

namespace espalier {

Picture draw_fitted_tree(const std::filesystem::path& run_directory, int size_px) {
  constexpr View kSides[] = {{0, 0}, {90, 0}, {45, 15}};
  const std::string file = (run_directory / "best.toml").string();
  Preset preset = load_preset(file);
  // Presets of versions before 0.2 do not name their seed.
  if (!preset.seed) preset.seed = read_record(run_directory / "run.toml").record.seed;
  const Plant plant = grow_preset(preset, file);
  ChartLayout layout;
  for (const View& side : kSides) {
    const Camera camera = frame_bounds(bounds(plant), side, size_px, size_px);
    const auto left = static_cast<float>(layout.images.size()) * static_cast<float>(size_px);
    layout.images.push_back({{left, 0}, render_shaded(plant, camera, {.samples_per_px = 16}), {}});
  }
  return layout_to_picture(layout, static_cast<int>(std::size(kSides)) * size_px, size_px);
}

}  // namespace espalier
