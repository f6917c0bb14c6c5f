#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/fitting/picture/picture_reading.h>
#include <espalier/fitting/posterior/simulations/crown_outline.h>
#include <espalier/fitting/posterior/simulations/oriented_runs.h>
#include <espalier/fitting/posterior/simulations/silhouette_summaries.h>
#include <espalier/fitting/posterior/simulations/summary_bands.h>
#include <espalier/image/masks/bits.h>
#include <espalier/image/masks/mask_box.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/masks/row_runs.h>
#include <espalier/image/reading/frame.h>

namespace espalier {

namespace {

constexpr std::array<int, 5> kRadiiPx{1, 2, 3, 5, 8};

/// Width between the outermost pixels, share of it that is set, and pieces that a row falls into.
void add_profile(const Mask& mask, const MaskBox& box, std::vector<double>& widths,
                 std::vector<double>& covers, std::vector<double>& pieces) {
  for (int band = 0; band < kHeights; ++band) {
    double extent = 0, set = 0, runs = 0;
    const Band rows = band_of(box, band, kHeights);
    for (int y = rows.first; y < rows.end; ++y) {
      extent += row_extent_px(mask, y);
      set += static_cast<double>(count_bits(mask.row(y)));
      runs += static_cast<double>(runs_of(mask, y).size());
    }
    widths.push_back(extent / (rows.end - rows.first) / box.height());
    covers.push_back(extent > 0 ? set / extent : 0);
    pieces.push_back(std::log1p(runs / (rows.end - rows.first)));
  }
}

/// How far the middle of each tier lies from the foot, to whichever side.
void add_offsets(const Mask& mask, const MaskBox& box, std::vector<double>& summaries) {
  for (int tier = 0; tier < kTiers; ++tier) {
    double sum = 0, count = 0;
    const Band rows = band_of(box, tier, kTiers);
    for (int y = rows.first; y < rows.end; ++y)
      for (const RowRun& run : runs_of(mask, y)) {
        sum += run.width() * static_cast<double>(run.middle());
        count += run.width();
      }
    summaries.push_back(count > 0 ? std::fabs(sum / count - 0.5 * mask.width_px()) / box.height() : 0);
  }
}

/// Sides of pixels between what is set and what is not, to the left and right and above and below them.
void add_boundaries(const Mask& mask, const MaskBox& box, std::vector<double>& summaries) {
  for (int tier = 0; tier < kTiers; ++tier) {
    double upright = 0, level = 0;
    const Band rows = band_of(box, tier, kTiers);
    for (int y = rows.first; y < rows.end; ++y) {
      upright += 2 * static_cast<double>(runs_of(mask, y).size());
      if (y > 0)
        level += static_cast<double>(count_and_not(mask.row(y), mask.row(y - 1)) +
                                     count_and_not(mask.row(y - 1), mask.row(y)));
    }
    summaries.push_back(std::log1p(upright / box.height()));
    summaries.push_back(std::log1p(level / box.height()));
  }
}

/// What is left of the area without pieces, and added to it by gaps, narrower than each disc: the sizes of
/// both (Matheron, Random Sets and Integral Geometry, 1975: granulometry).
void add_sizes(const Mask& mask, std::vector<double>& summaries) {
  const auto area = static_cast<double>(area_px(mask));
  for (const int radius_px : kRadiiPx)
    summaries.push_back(static_cast<double>(area_px(dilate_disc(erode_disc(mask, radius_px), radius_px))) /
                        area);
  for (const int radius_px : kRadiiPx)
    summaries.push_back(static_cast<double>(area_px(close_disc(mask, radius_px))) / area);
}

void add_reading(const Mask& mask, std::vector<double>& summaries) {
  const PictureReading reading = read_picture(mask);
  for (const double measure : {reading.trunk_width, reading.foot_width, reading.crown_base,
                               reading.crown_width, reading.cover, reading.hull_cover, reading.clump_width})
    summaries.push_back(measure);
}

std::vector<std::string> make_names() {
  std::vector<std::string> names;
  for (const char* what : {"width", "cover", "pieces"})
    for (int band = 0; band < kHeights; ++band) names.push_back(fmt::format("{} {:02}", what, band + 1));
  for (int tier = 0; tier < kTiers; ++tier) names.push_back(fmt::format("offset {}", tier + 1));
  for (int tier = 0; tier < kTiers; ++tier)
    for (const char* side : {"upright", "level"})
      names.push_back(fmt::format("{} boundary {}", side, tier + 1));
  for (const char* what : {"left without pieces", "with gaps filled"})
    for (const int radius_px : kRadiiPx) names.push_back(fmt::format("{} within {} px", what, radius_px));
  for (const char* what :
       {"trunk width", "foot width", "bare height", "crown width", "cover", "hull cover", "clump width"})
    names.emplace_back(what);
  names.emplace_back("area");
  name_oriented_runs(names);
  name_crown_outline(names);
  return names;
}

}  // namespace

const std::vector<std::string>& summary_names() {
  static const std::vector<std::string> names = make_names();
  return names;
}

std::vector<double> summaries_of(const Mask& mask) {
  const MaskBox box = box_of(mask);
  if (box.is_empty()) throw_input_error("posterior: got an empty silhouette, expected a tree");
  std::vector<double> summaries, covers, pieces;
  add_profile(mask, box, summaries, covers, pieces);
  summaries.insert(summaries.end(), covers.begin(), covers.end());
  summaries.insert(summaries.end(), pieces.begin(), pieces.end());
  add_offsets(mask, box, summaries);
  add_boundaries(mask, box, summaries);
  add_sizes(mask, summaries);
  add_reading(mask, summaries);
  summaries.push_back(static_cast<double>(area_px(mask)) / box.height() / box.height());
  add_oriented_runs(mask, box, summaries);
  add_crown_outline(mask, box, summaries);
  ESPALIER_CHECK_EQ(summaries.size(), summary_names().size());
  return summaries;
}

Mask framed_for_summaries(const Mask& mask) {
  if (box_of(mask).is_empty()) throw_input_error("posterior: got an empty mask, expected a tree");
  const Framing framing = framing_of(mask, kSummaryFramePx);
  Mask framed(kSummaryFramePx, kSummaryFramePx);
  for (int y = 0; y < kSummaryFramePx; ++y)
    for (int x = 0; x < kSummaryFramePx; ++x) {
      const double source_x = framing.foot_x + (x + 0.5 - 0.5 * kSummaryFramePx) / framing.frame_px_per_px;
      const double source_y = framing.foot_y + (y + 0.5 - static_cast<double>(base_row_px(kSummaryFramePx))) /
                                                   framing.frame_px_per_px;
      const int i = static_cast<int>(std::floor(source_x)), j = static_cast<int>(std::floor(source_y));
      if (i >= 0 && j >= 0 && i < mask.width_px() && j < mask.height_px() && mask.get(i, j)) framed.set(x, y);
    }
  if (area_px(framed) == 0)
    throw_input_error("posterior: got a tree too thin for {} pixels, expected a thicker one",
                      kSummaryFramePx);
  return framed;
}

}  // namespace espalier
