#include <algorithm>
#include <cmath>

#include <espalier/fitting/picture/trunk_line.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/masks/row_runs.h>

namespace espalier {

namespace {

bool is_narrower(const RowRun& a, const RowRun& b) { return a.width() < b.width(); }

/// The run of the row that lies above `below`; none where there is no such run.
std::optional<RowRun> run_above(const Mask& mask, int y, const RowRun& below) {
  std::optional<RowRun> widest;
  for (const RowRun& run : runs_of(mask, y)) {
    if (run.touches(below) && (!widest || is_narrower(*widest, run))) widest = run;
  }
  return widest;
}

int lowest_row(const Mask& mask) {
  int y = mask.height_px() - 1;
  while (y >= 0 && runs_of(mask, y).empty()) --y;
  return y;
}

float median_width(std::vector<RowRun> runs) {
  const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
  std::nth_element(runs.begin(), middle, runs.end(), is_narrower);
  return static_cast<float>(middle->width());
}

/// The bare trunk's runs from the foot up, until one is half as wide again as the trunk was so far.
std::vector<RowRun> bare_trunk(const Mask& mask, int foot) {
  constexpr float kCrown = 1.5f;
  std::vector<RowRun> trunk{widest_run(mask, foot)};
  for (int y = foot - 1; y >= 0; --y) {
    const std::optional<RowRun> run = run_above(mask, y, trunk.back());
    if (!run || static_cast<float>(run->width()) > kCrown * median_width(trunk) + 1) break;
    trunk.push_back(*run);
  }
  return trunk;
}

/// The mean place of what is left last when the mask is eroded again and again.
PixelPoint middle_of_largest_disc(Mask mask) {
  for (Mask eroded = erode_disc(mask, 1); area_px(eroded) > 0; eroded = erode_disc(mask, 1)) mask = eroded;
  double x_sum = 0, y_sum = 0;
  for (int y = 0; y < mask.height_px(); ++y)
    for (const RowRun& run : runs_of(mask, y)) {
      x_sum += static_cast<double>(run.middle()) * run.width();
      y_sum += (y + 0.5) * run.width();
    }
  const auto area = static_cast<double>(area_px(mask));
  return {static_cast<float>(x_sum / area), static_cast<float>(y_sum / area)};
}

Mask rows_above(Mask mask, int end) {
  for (int y = end; y < mask.height_px(); ++y) std::ranges::fill(mask.row(y), 0);
  return mask;
}

}  // namespace

float TrunkLine::length_px() const {
  float length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
  return length;
}

std::optional<TrunkLine> read_trunk_line(const Mask& mask) {
  constexpr std::size_t kFewestRows = 10;
  const int foot = lowest_row(mask);
  if (foot < 0) return std::nullopt;
  const std::vector<RowRun> trunk = bare_trunk(mask, foot);
  const int crown_end = foot + 1 - static_cast<int>(trunk.size());
  const Mask crown = rows_above(mask, crown_end);
  if (trunk.size() < kFewestRows || area_px(crown) == 0) return std::nullopt;
  const std::size_t fifth = trunk.size() / 5;
  const auto part = static_cast<std::ptrdiff_t>(fifth);
  TrunkLine line{.foot_width_px = median_width({trunk.begin(), trunk.begin() + part}),
                 .top_width_px = median_width({trunk.end() - part, trunk.end()})};
  for (std::size_t i = 0; i < trunk.size(); i += fifth)
    line.points.push_back(
        {trunk[i].middle(), static_cast<float>(foot) + (i == 0 ? 1.f : 0.5f) - static_cast<float>(i)});
  line.points.push_back(middle_of_largest_disc(crown));
  return line;
}

}  // namespace espalier
