#include <algorithm>

#include <espalier/image/masks/morphology.h>
#include <espalier/image/reading/roots.h>

namespace espalier {

namespace {

constexpr double kHighestFork = 0.12;  ///< of the height: above it trunks fork, not roots
constexpr double kLowestFork = 0.03;   ///< below it the ground is rough
constexpr double kTrunk = 0.1;         ///< of the height, above the fork: where a trunk is narrowest
constexpr double kWidestTrunk = 0.4;   ///< of the tree's width
constexpr double kFlare = 2.2;         ///< roots that spread wider, in trunks, are branches that hang down
constexpr double kFoot = 0.2;          ///< of the trunk's width: thinner ones are twigs

/// The run that joins feet of the row below it, and them alone.
std::optional<RowRun> joint_above(const Mask& mask, int y) {
  const std::vector<RowRun> feet = runs_of(mask, y), above = runs_of(mask, y - 1);
  if (feet.size() < 2 || above.size() != 1) return std::nullopt;
  const auto joined = std::ranges::count_if(feet, [&](const RowRun& foot) { return foot.touches(above[0]); });
  return joined > 1 ? std::optional(above[0]) : std::nullopt;
}

/// The narrowest run from this one up, as long as one run follows another.
RowRun narrowest_above(const Mask& mask, RowRun run, int y, int end_row) {
  RowRun narrowest = run;
  for (--y; y >= end_row; --y) {
    RowRun next;
    for (const RowRun& above : runs_of(mask, y))
      if (above.touches(run) && above.width() > next.width()) next = above;
    if (next.width() == 0) break;
    run = next;
    if (run.width() < narrowest.width()) narrowest = run;
  }
  return narrowest;
}

/// Whether there are at least two feet at the fork.
bool has_feet(const Mask& mask, const Roots& roots) {
  return std::ranges::count_if(runs_of(mask, roots.fork_row), [&](const RowRun& foot) {
           return foot.width() >= kFoot * roots.trunk.width();
         }) > 1;
}

/// A trunk, that is bare above its feet.
bool is_trunk(const Mask& mask, const MaskBox& box, const Roots& roots, int end_row) {
  const int trunk_px = roots.trunk.width();
  return trunk_px <= roots.width_px && trunk_px < kWidestTrunk * box.width() &&
         extent_px(mask, end_row, box.bottom) <= kFlare * trunk_px;
}

}  // namespace

std::optional<Roots> roots_of(const Mask& mask_with_holes, const MaskBox& box) {
  const Mask mask = fill_holes(mask_with_holes);  // between roots the background shows
  const int highest = std::max(box.top + 1, box.bottom - box.rows(kHighestFork));
  for (int y = highest; y < box.bottom - box.rows(kLowestFork); ++y) {
    const std::optional<RowRun> joint = joint_above(mask, y);
    if (!joint) continue;
    const int end_row = std::max(box.top, y - box.rows(kTrunk));
    const Roots roots{y, narrowest_above(mask, *joint, y - 1, end_row), extent_px(mask, y, box.bottom)};
    if (is_trunk(mask, box, roots, end_row) && has_feet(mask, roots)) return roots;
  }
  return std::nullopt;
}

Mask without_roots(Mask mask) {
  const MaskBox box = box_of(mask);
  const std::optional<Roots> roots = roots_of(mask, box);
  if (!roots) return mask;
  for (int y = roots->fork_row; y < box.bottom; ++y) {
    std::ranges::fill(mask.row(y), 0);
    for (int x = roots->trunk.first; x <= roots->trunk.last; ++x) mask.set(x, y);
  }
  return mask;
}

}  // namespace espalier
