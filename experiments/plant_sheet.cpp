// Plants side by side, each shaded from the front and from the side, as large as its tile: do fits look like
// the bundled species between which they stand? Names of presets or of run directories, in rows of five;
// under each its name, the share of it that shows wood, and its depth over its width.
//   build/bin/plant_sheet sheet.png acer apple runs/fir
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include <espalier/charts/chart_layout.h>
#include <espalier/core/error.h>
#include <espalier/core/parallel_for.h>
#include <espalier/fitting/run/plant_portrait.h>
#include <espalier/fitting/species_space/preset_collection.h>
#include <espalier/models/grow_preset.h>
#include <espalier/render/shading/shaded.h>

namespace espalier {
namespace {

constexpr int kTilePx = 200, kLinePx = 16, kGapPx = 6, kSamples = 9;
constexpr std::size_t kPlantsInARow = 5;

struct DrawnPlant {
  Picture front, side;
  std::string name, measures;
};

/// Both sides at one scale, that of the larger one.
DrawnPlant draw_plant(const Preset& preset) {
  const Plant plant = grow_preset(preset, preset.name);
  const View front{}, side{.azimuth_deg = 90};
  const Bounds box = bounds(plant);
  const Camera from_front = frame_bounds(box, front, kTilePx, kTilePx);
  const Camera from_side = frame_bounds(box, side, kTilePx, kTilePx);
  const PlantPortrait portrait = portray(plant, front, preset.overrides);
  return {render_shaded(plant, from_front, {.samples_per_px = kSamples}),
          render_shaded(plant, from_side, {.samples_per_px = kSamples}), preset.name,
          fmt::format("wood {:.2f}, depth {:.2f}", portrait.visible_wood, portrait.depth_over_width)};
}

Picture sheet_of(const std::vector<DrawnPlant>& plants) {
  constexpr int kStepX = 2 * kTilePx + kGapPx, kStepY = kTilePx + 2 * kLinePx;
  ChartLayout layout;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    const std::size_t row = i / kPlantsInARow, column = i % kPlantsInARow;
    const auto x = static_cast<float>(column) * kStepX, y = static_cast<float>(row) * kStepY;
    layout.images.push_back({{x, y}, plants[i].front, {}});
    layout.images.push_back({{x + kTilePx, y}, plants[i].side, {}});
    layout.labels.push_back({{x + kTilePx, y + kTilePx + 0.5F * kLinePx}, plants[i].name});
    layout.labels.push_back({{x + kTilePx, y + kTilePx + 1.5F * kLinePx}, plants[i].measures});
  }
  const std::size_t columns = std::min(plants.size(), kPlantsInARow);
  const std::size_t rows = (plants.size() + kPlantsInARow - 1) / kPlantsInARow;
  return layout_to_picture(layout, static_cast<int>(columns) * kStepX - kGapPx,
                           static_cast<int>(rows) * kStepY);
}

void draw_sheet(const std::string& output, const std::vector<std::string>& names) {
  const std::vector<Preset> presets = load_presets(names);
  std::vector<DrawnPlant> plants(presets.size());
  parallel_for(presets.size(), [&](std::size_t i) { plants[i] = draw_plant(presets[i]); });
  write_png(output, sheet_of(plants));
}

}  // namespace
}  // namespace espalier

int main(int argc, char** argv) {
  using namespace espalier;
  if (argc < 3) {
    fmt::print(stderr, "{}: got {} words, expected a picture to write and presets or runs\n", argv[0],
               argc - 1);
    return 2;
  }
  try {
    draw_sheet(argv[1], {argv + 2, argv + argc});
  } catch (const InputError& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return 2;
  }
  return 0;
}
