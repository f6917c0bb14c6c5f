#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <espalier/charts/chart_layout.h>
#include <espalier/core/parallel_for.h>
#include <espalier/fitting/species_pictures/plant_pictures.h>
#include <espalier/fitting/starts/thinning.h>
#include <espalier/image/reading/frame.h>
#include <espalier/render/scanlines/scanline_renderer.h>
#include <espalier/render/shading/shaded.h>
#include <espalier/render/silhouette.h>

namespace espalier {

namespace {

constexpr int kTextRowPx = 24, kGapPx = 4, kSamples = 5;

ShadedSettings on_white() {
  ShadedSettings settings;
  settings.samples_per_px = kSamples;
  settings.background_top = settings.background_bottom = {1, 1, 1};
  return settings;
}

/// Grows the plant, thinned where it is beyond the budget; empty where that does not help.
Plant grown(const Model& model, const ParameterValues& values, const TileView& view) {
  Plant plant;
  ParameterValues thinned = values;
  if (model.generate(values, view.seed, {view.budget, nullptr}, plant).grown) return plant;
  if (!thin_until_grown(model, view.budget, view.seed, thinned) ||
      !model.generate(thinned, view.seed, {view.budget, nullptr}, plant).grown)
    plant.clear();
  return plant;
}

Camera tile_camera(double frame, int size_px) {
  return frame_base({0, 0, 0}, {}, static_cast<float>(frame / size_px), size_px, size_px,
                    base_row_px(size_px));
}

Picture shaded_tile(const Model& model, const PlantTile& tile, const TileView& view) {
  const Plant plant = grown(model, tile.values, view);
  if (plant.stems.size() == 0) return Picture(view.size_px, view.size_px, {255, 255, 255});
  const double frame = std::max(frame_m(plant), tile.least_frame_m);
  return render_shaded(plant, tile_camera(frame, view.size_px), on_white());
}

double grown_frame_m(const Model& model, const ParameterValues& values, Seed seed) {
  return frame_m(grown(model, values, {.seed = seed}));
}

}  // namespace

double frame_m(const Plant& plant) {
  constexpr double kLeastM = 1e-3;
  const Bounds box = bounds(plant);
  const double half_width_m = std::max(-box.lower.x, box.upper.x);
  return std::max(
      {static_cast<double>(box.upper.z) / kFramedHeight, half_width_m / kFramedHalfWidth, kLeastM});
}

Picture tile_picture(const Model& model, const std::vector<std::vector<PlantTile>>& rows,
                     const TileView& view) {
  std::size_t columns = 1;
  for (const auto& row : rows) columns = std::max(columns, row.size());
  const int step_x = view.size_px + kGapPx, step_y = view.size_px + kTextRowPx;
  std::vector<const PlantTile*> tiles;
  ChartLayout layout;
  for (std::size_t j = 0; j < rows.size(); ++j)
    for (std::size_t i = 0; i < rows[j].size(); ++i) {
      const ChartPoint corner{static_cast<float>(static_cast<int>(i) * step_x),
                              static_cast<float>(static_cast<int>(j) * step_y)};
      const auto size = static_cast<float>(view.size_px);
      tiles.push_back(&rows[j][i]);
      layout.images.push_back({corner, {}, {}});
      layout.labels.push_back(
          {{corner.x_px + size / 2, corner.y_px + size + 0.5F * kTextRowPx}, rows[j][i].text});
    }
  parallel_for(tiles.size(),
               [&](std::size_t i) { layout.images[i].picture = shaded_tile(model, *tiles[i], view); });
  return layout_to_picture(layout, static_cast<int>(columns) * step_x - kGapPx,
                           static_cast<int>(rows.size()) * step_y);
}

std::vector<PlantTile> strip_tiles(const Model& model, const std::vector<ParameterValues>& strip,
                                   const std::string& title, Seed seed) {
  const double first = grown_frame_m(model, strip.front(), seed);
  const double last = grown_frame_m(model, strip.back(), seed);
  std::vector<PlantTile> tiles;
  for (std::size_t i = 0; i < strip.size(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(strip.size() - 1, 1));
    tiles.push_back({strip[i], fmt::format("{}t = {:.2f}", title, t), first * std::pow(last / first, t)});
  }
  return tiles;
}

CutOutPlant cut_out_plant(const Model& model, const ParameterValues& values, const TileView& view) {
  constexpr int kFiner = 4;
  const Plant plant = grown(model, values, view);
  const double frame = frame_m(plant);
  CutOutPlant cut{render_shaded(plant, tile_camera(frame, view.size_px), on_white()), {}};
  Mask mask;
  make_scanline_renderer()->draw(plant, tile_camera(frame, kFiner * view.size_px), mask);
  for (int y = 0; y < view.size_px; ++y)
    for (int x = 0; x < view.size_px; ++x) {
      int covered = 0;
      for (int k = 0; k < kFiner * kFiner; ++k)
        covered += mask.get(kFiner * x + k % kFiner, kFiner * y + k / kFiner);
      const double share = static_cast<double>(covered) / (kFiner * kFiner);
      cut.cover.push_back(static_cast<std::uint8_t>(std::lround(255 * share)));
      Rgb& pixel = cut.picture.at(x, y);  // without the white that shines through
      for (std::uint8_t* channel : {&pixel.r, &pixel.g, &pixel.b})
        if (share > 0)
          *channel =
              static_cast<std::uint8_t>(std::clamp(std::lround(255 - (255 - *channel) / share), 0L, 255L));
    }
  return cut;
}

}  // namespace espalier
