#include <algorithm>
#include <cmath>

#include <espalier/app/commands/target_sheet.h>
#include <espalier/image/reading/label_picture.h>

namespace espalier {

namespace {

constexpr float kPaper = 0.85f;  ///< behind what is transparent
constexpr int kGapPx = 4;

/// The part of a panel that shows a picture of another shape, and how many of its pixels one of the panel is.
struct Fitting {
  int width_px, height_px;
  double px_per_px;
};

Fitting fit_into(int width_px, int height_px, int side_px) {
  const double scale = static_cast<double>(std::max(width_px, height_px)) / side_px;
  return {std::max(1, static_cast<int>(width_px / scale)), std::max(1, static_cast<int>(height_px / scale)),
          scale};
}

Rgb color_on_paper(const Rgba& rgba) {
  const auto channel = [&](float value) {
    return static_cast<std::uint8_t>(
        std::lround(std::clamp(value + kPaper * (1 - rgba[3]), 0.0f, 1.0f) * 255));
  };
  return {channel(rgba[0]), channel(rgba[1]), channel(rgba[2])};
}

/// `color_at`(x, y) of a source of this size, into the panel that begins at column `left`.
template <typename ColorAt>
void draw_panel(int width_px, int height_px, int left, ColorAt color_at, Picture& sheet) {
  const Fitting fitting = fit_into(width_px, height_px, sheet.height_px);
  for (int y = 0; y < fitting.height_px; ++y)
    for (int x = 0; x < fitting.width_px; ++x)
      sheet.at(left + x, y) =
          color_at(std::min(width_px - 1, static_cast<int>((x + 0.5) * fitting.px_per_px)),
                   std::min(height_px - 1, static_cast<int>((y + 0.5) * fitting.px_per_px)));
}

}  // namespace

Picture target_sheet(const DecodedPicture& picture, const TargetPicture& target) {
  const int side_px = target.mask.width_px(), step_px = side_px + kGapPx;
  Picture sheet(4 * step_px - kGapPx, side_px, {255, 255, 255});
  draw_panel(
      picture.width_px, picture.height_px, 0, [&](int x, int y) { return color_on_paper(picture.at(x, y)); },
      sheet);
  draw_panel(
      picture.width_px, picture.height_px, step_px,
      [&](int x, int y) {
        if (target.source_tree.get(x, y)) return kPaleTreeColor;
        return target.source_marks.get(x, y) ? kLeftOutColor : Rgb{235, 235, 235};
      },
      sheet);
  draw_panel(
      side_px, side_px, 2 * step_px,
      [&](int x, int y) {
        return target.mask.get(x, y) ? Rgb{255, 255, 255} : Rgb{0, 0, 0};
      },
      sheet);
  const Picture labels = label_picture(target.mask, target.labels);
  draw_panel(
      side_px, side_px, 3 * step_px, [&](int x, int y) { return labels.at(x, y); }, sheet);
  return sheet;
}

}  // namespace espalier
