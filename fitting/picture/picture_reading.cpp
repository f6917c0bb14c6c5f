#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/fitting/picture/picture_reading.h>
#include <espalier/fitting/picture/trunk_measures.h>
#include <espalier/image/masks/convex_hull.h>
#include <espalier/image/masks/mask_box.h>
#include <espalier/image/masks/morphology.h>

namespace espalier {

namespace {

/// The mask with a frame around it, so that closing is not cut off.
Mask padded(const Mask& mask, int frame_px) {
  Mask wide(mask.width_px() + 2 * frame_px, mask.height_px() + 2 * frame_px);
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      if (mask.get(x, y)) wide.set(x + frame_px, y + frame_px);
  return wide;
}

double cover_of(const Mask& mask, const MaskBox& box) {
  constexpr double kGapsClosed = 0.08;  ///< of the height: wider than gaps between twigs
  const int radius_px = std::max(1, static_cast<int>(std::lround(kGapsClosed * box.height())));
  const Mask outline = fill_holes(close_disc(padded(mask, 2 * radius_px), radius_px));
  return static_cast<double>(area_px(mask)) / static_cast<double>(area_px(outline));
}

/// How many sides of pixels lie between what is set and what is not; nothing is set at the frame.
std::size_t boundary_px(const Mask& mask) {
  std::size_t sides = 0;
  for (int y = 1; y < mask.height_px(); ++y)
    for (int x = 1; x < mask.width_px(); ++x)
      sides += (mask.get(x, y) != mask.get(x - 1, y)) + (mask.get(x, y) != mask.get(x, y - 1));
  return sides;
}

/// Twice the area over the boundary: the width of a long strip. Closing first makes it the same at any
/// resolution.
double clump_width_px(const Mask& mask, const MaskBox& box) {
  constexpr double kGapsClosed = 0.008;  ///< of the height: a pixel of a fit's usual mask
  const int radius_px = std::max(1, static_cast<int>(std::lround(kGapsClosed * box.height())));
  const Mask closed = close_disc(padded(mask, 2 * radius_px), radius_px);
  return 2 * static_cast<double>(area_px(closed)) / static_cast<double>(boundary_px(closed));
}

/// Winter trees and palms are open: most of their convex hull is background, and what their closed outline
/// holds is not filled either, unless their branches are few. An open crown whose leaves stand in clumps
/// covers more of its hull than a winter tree, and is wider where it is set. A palm has a high, thin trunk
/// below its fronds. The limits are where the pictures of the species presets, bare and in leaf, and of trees
/// that no generator made fall apart.
TreeKind kind_of(const PictureReading& reading) {
  const bool has_few_branches = reading.hull_cover < 0.35;
  const bool is_open = reading.hull_cover < 0.51 && reading.cover < 0.745;
  const bool is_open_crown = reading.hull_cover < 0.56 && reading.cover < 0.8;
  if (is_open_crown && reading.crown_base >= 0.4 && reading.trunk_width < 0.15) return TreeKind::palm;
  const bool has_clumps = reading.hull_cover >= 0.4 && reading.clump_width >= 0.038;
  return has_few_branches || (is_open && !has_clumps) ? TreeKind::leafless : TreeKind::leafy;
}

}  // namespace

PictureReading read_picture(const Mask& mask) {
  const MaskBox box = box_of(mask);
  if (box.is_empty()) throw_input_error("picture: got an empty mask, expected a tree");
  const double height = box.height();
  const TrunkMeasures trunk = measure_trunk(mask, box);
  PictureReading reading;
  reading.height_px = box.height();
  reading.trunk_width = trunk.width_px / height;
  reading.foot_width = trunk.foot_width_px / height;
  reading.stand_height = trunk.stand_px / height;
  reading.crown_base = trunk.bare_px / height;
  reading.crown_width = box.width() / height;
  reading.trunks = trunk.stems;
  reading.cover = cover_of(mask, box);
  reading.hull_cover = static_cast<double>(area_px(mask)) / convex_hull_area_px(mask);
  reading.clump_width = clump_width_px(mask, box) / height;
  reading.touches_frame = box.left == 0 || box.top == 0 || box.right == mask.width_px();
  reading.kind = kind_of(reading);
  return reading;
}

TreeKind kind_with_labels(TreeKind of_outline, const PlantLabels& labels) {
  constexpr double kLeavesOfALeafyTree = 0.3;  ///< of its pixels; the bare trees of docs/labels.md have none
  return of_outline == TreeKind::leafless && labels.leaf_share >= kLeavesOfALeafyTree ? TreeKind::leafy
                                                                                      : of_outline;
}

}  // namespace espalier
