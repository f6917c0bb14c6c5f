#include <algorithm>
#include <optional>

#include <espalier/fitting/picture/trunk_measures.h>
#include <espalier/image/masks/row_runs.h>
#include <espalier/image/reading/roots.h>

namespace espalier {

namespace {

constexpr double kFoot = 0.06;         ///< of the height: roots, grass, twigs that hang down
constexpr double kTrunkOrCrown = 2.2;  ///< as wide as this many trunks: no trunk that leans or flares

/// The row a little above the foot, where roots and grass no longer show.
int foot_row(const MaskBox& box) { return std::max(box.top, box.bottom - 1 - box.rows(0.03)); }

/// The narrowest row near the foot: above roots and grass, and between twigs that hang down to them.
int width_near_foot_px(const Mask& mask, const MaskBox& box) {
  int narrowest = widest_run(mask, foot_row(box)).width();
  const int top = std::max(box.top, box.bottom - 1 - box.rows(kFoot));
  for (int y = top; y < box.bottom - 1; ++y) narrowest = std::min(narrowest, widest_run(mask, y).width());
  return std::max(narrowest, 1);
}

/// Rows from the foot up that are at most so wide.
int rows_within(const Mask& mask, const MaskBox& box, double width_px) {
  int rows = 0;
  while (rows < box.height() && row_extent_px(mask, box.bottom - 1 - rows) <= width_px) ++rows;
  return rows;
}

/// A crown that is narrow beside its trunk begins where the outline becomes wider than halfway between them.
int bare_height_px(const Mask& mask, const MaskBox& box, int trunk_px) {
  const int rows = rows_within(mask, box, kTrunkOrCrown * trunk_px);
  if (rows < box.height()) return rows;
  int widest_px = 0;
  for (int y = box.top; y < box.bottom; ++y) widest_px = std::max(widest_px, row_extent_px(mask, y));
  return rows_within(mask, box, 0.5 * (trunk_px + widest_px));
}

struct Waist {
  int width_px = 0;
  int rows_below = 0;  ///< from the foot up to it
  int rows = 0;        ///< from the foot up to the crown above it
};

/// The narrowest row between the foot and the crown, if what is below it bulges: a mound, a pot or a stand,
/// where the foot of a trunk is widest at the ground.
std::optional<Waist> waist_of(const Mask& mask, const MaskBox& box) {
  constexpr double kHighest = 0.5;  // of the height: above it are gaps between tiers, and tips
  constexpr double kBulge = 1.2;    // of the width at the ground
  const int ground_px = widest_run(mask, box.bottom - 1).width();
  Waist waist{.width_px = mask.width_px()};
  int widest_below_px = 0, widest_px = 0;
  for (; waist.rows < kHighest * box.height(); ++waist.rows) {
    const int width_px = row_extent_px(mask, box.bottom - 1 - waist.rows);
    const bool is_above_foot = waist.rows > box.rows(kFoot);
    if (is_above_foot && width_px > kTrunkOrCrown * waist.width_px) {
      const bool bulges =
          widest_below_px >= kTrunkOrCrown * waist.width_px && widest_below_px >= kBulge * ground_px;
      return bulges ? std::optional(waist) : std::nullopt;
    }
    widest_px = std::max(widest_px, width_px);
    if (is_above_foot && width_px > 0 && width_px < waist.width_px) {
      waist.width_px = width_px;
      waist.rows_below = waist.rows;
      widest_below_px = widest_px;
    }
  }
  return std::nullopt;
}

TrunkMeasures measure_above_roots(const Mask& mask, const MaskBox& box, const Roots& roots) {
  return {.width_px = roots.trunk.width(),
          .bare_px = bare_height_px(mask, box, roots.trunk.width()),
          .foot_width_px = roots.width_px,
          .stems = 1};
}

}  // namespace

TrunkMeasures measure_trunk(const Mask& mask, const MaskBox& box) {
  // A waist so much wider than the foot is of branches that hang down beside it.
  constexpr double kTwigs = 1.5;
  if (const std::optional<Roots> roots = roots_of(mask, box)) return measure_above_roots(mask, box, *roots);
  TrunkMeasures trunk{.width_px = width_near_foot_px(mask, box),
                      .foot_width_px = widest_run(mask, box.bottom - 1).width(),
                      .stems = static_cast<int>(runs_of(mask, foot_row(box)).size())};
  trunk.bare_px = bare_height_px(mask, box, trunk.width_px);
  const std::optional<Waist> waist = waist_of(mask, box);
  if (waist && waist->width_px < kTwigs * trunk.width_px) {
    trunk.width_px = waist->width_px;
    trunk.bare_px = waist->rows;
    trunk.stand_px = waist->rows_below;
  }
  return trunk;
}

}  // namespace espalier
