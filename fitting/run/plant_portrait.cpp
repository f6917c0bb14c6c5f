#include <algorithm>

#include <espalier/charts/chart_layout.h>
#include <espalier/fitting/branches/branch_offsets.h>
#include <espalier/fitting/run/plant_portrait.h>
#include <espalier/image/masks/mask_box.h>
#include <espalier/image/reading/frame.h>
#include <espalier/image/reading/label_picture.h>
#include <espalier/render/camera.h>
#include <espalier/render/embree/visible_parts.h>
#include <espalier/render/shading/shaded.h>

namespace espalier {

namespace {

constexpr int kMeasuredPx = 256;  ///< side of the picture that wood is counted in
constexpr int kMaxTilePx = 320, kMinTilePx = 120, kMarginPx = 8, kTitlePx = 20;
constexpr int kSamples = 4;  ///< rays a pixel of the sheet: with 9 it took most of the time of a short fit

/// The extent of the plant in this box across a direction that looks at it from `azimuth_deg`.
float width_m(const Plant& plant, const Bounds& box, float azimuth_deg) {
  const Camera camera = frame_bounds(box, {azimuth_deg, 0}, kMeasuredPx, kMeasuredPx);
  Mask mask;
  make_scanline_renderer()->draw(plant, camera, mask);
  return area_px(mask) == 0 ? 0 : static_cast<float>(box_of(mask).width()) * camera.metres_per_px;
}

/// Trunks of no thickness.
Plant without_trunks(Plant plant) {
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    if (plant.stems.level[stem] == 0)
      std::fill(plant.knots.radius_m.begin() + plant.stems.first_knot[stem],
                plant.knots.radius_m.begin() + plant.stems.first_knot[stem + 1], 0.0F);
  return plant;
}

/// Side of a tile: a mask of 32 pixels is not worth one of 320.
int tile_px(const TargetView& target) {
  return std::clamp(5 * target.target.mask().width_px() / 2, kMinTilePx, kMaxTilePx);
}

/// The target and its labels, as large as a tile.
Picture target_tile(const TargetView& target) {
  const int side_px = tile_px(target);
  const Picture labels = label_picture(target.target.mask(), target.labels);
  Picture tile(side_px, side_px);
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x)
      tile.at(x, y) = labels.at(x * labels.width_px / side_px, y * labels.height_px / side_px);
  return tile;
}

/// The target's camera for a tile, from another side.
Camera tile_camera(const TargetView& target, const View& view) {
  const int side_px = tile_px(target);
  const float metres_per_px = target.metres_per_px * static_cast<float>(target.target.mask().width_px()) /
                              static_cast<float>(side_px);
  return frame_base({0, 0, 0}, view, metres_per_px, side_px, side_px, base_row_px(side_px));
}

}  // namespace

PlantPortrait portray(const Plant& plant, const View& front, const Overrides& overrides) {
  const View level{front.azimuth_deg, 0};
  const Bounds box = bounds(plant);
  const Camera camera = frame_bounds(box, level, kMeasuredPx, kMeasuredPx);
  const float width = width_m(plant, box, front.azimuth_deg),
              depth = width_m(plant, box, front.azimuth_deg + 90);
  return {.visible_wood = count_visible_parts(plant, camera).wood_share(),
          .crown_wood = count_visible_parts(without_trunks(plant), camera).wood_share(),
          .depth_over_width = width > 0 ? depth / width : 0,
          .stems = static_cast<double>(plant.stems.size()),
          .leaves = static_cast<double>(plant.leaves.size()),
          .override_numbers = static_cast<double>(count_numbers(overrides))};
}

Picture plant_sheet(const Plant& plant, const TargetView& target, const View& front) {
  const auto from = [&](float azimuth, float elevation) {
    return tile_camera(target, {front.azimuth_deg + azimuth, elevation});
  };
  const Camera cameras[] = {from(0, 0), from(90, 0), from(45, 15)};
  const std::vector<Picture> shaded = render_shaded(plant, cameras, {.samples_per_px = kSamples});
  struct Tile {
    const char* title;
    Picture picture;
  };
  const Tile tiles[] = {{"target", target_tile(target)},
                        {"front", shaded[0]},
                        {"side", shaded[1]},
                        {"three quarters", shaded[2]}};
  const int side_px = tile_px(target);
  ChartLayout layout;
  float left = kMarginPx;
  for (const Tile& tile : tiles) {
    layout.labels.push_back(
        {{left + static_cast<float>(side_px) / 2, kTitlePx / 2.0f}, tile.title, TextAnchor::middle});
    layout.images.push_back({{left, kTitlePx}, tile.picture, {}});
    left += static_cast<float>(side_px + kMarginPx);
  }
  return layout_to_picture(layout, static_cast<int>(left), kTitlePx + side_px + kMarginPx);
}

}  // namespace espalier
