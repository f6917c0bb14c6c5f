#include "fitting/stages/picture_reading.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "image/morphology.h"

namespace espalier {

namespace {

struct Box {
  int left = 0, top = 0, right = -1, bottom = -1;  ///< inclusive
  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
};

Box box_of(const Mask& mask) {
  Box box{mask.width_px(), mask.height_px(), -1, -1};
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      if (mask.get(x, y))
        box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x), std::max(box.bottom, y)};
  return box;
}

/// Columns between the first and the last set pixel of a row.
int extent_px(const Mask& mask, int y) {
  int first = -1, last = -2;
  for (int x = 0; x < mask.width_px(); ++x) {
    if (!mask.get(x, y)) continue;
    if (first < 0) first = x;
    last = x;
  }
  return last - first + 1;
}

/// The row a little above the foot, where roots and grass no longer show.
int foot_row(const Box& box) {
  return std::max(box.top, box.bottom - static_cast<int>(std::lround(0.03 * box.height())));
}

/// Runs of set pixels in a row.
int runs_in_row(const Mask& mask, int y) {
  int runs = 0;
  for (int x = 0; x < mask.width_px(); ++x)
    if (mask.get(x, y) && (x == 0 || !mask.get(x - 1, y))) ++runs;
  return runs;
}

int longest_run_px(const Mask& mask, int y) {
  int longest = 0, run = 0;
  for (int x = 0; x < mask.width_px(); ++x) {
    run = mask.get(x, y) ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest;
}

/// The narrowest row near the foot: above roots and grass, and between twigs that hang down to them.
int trunk_width_px(const Mask& mask, const Box& box) {
  constexpr double kFoot = 0.06;  ///< of the height
  int narrowest = longest_run_px(mask, foot_row(box));
  const int top = std::max(box.top, box.bottom - static_cast<int>(std::lround(kFoot * box.height())));
  for (int y = top; y < box.bottom; ++y) narrowest = std::min(narrowest, longest_run_px(mask, y));
  return std::max(narrowest, 1);
}

/// Rows from the foot up that are no wider than a trunk that leans or flares.
int bare_height_px(const Mask& mask, const Box& box, int trunk_px) {
  constexpr double kTrunkOrCrown = 2.2;
  int rows = 0;
  while (rows < box.height() && extent_px(mask, box.bottom - rows) <= kTrunkOrCrown * trunk_px) ++rows;
  return rows;
}

/// The mask with a frame around it, so that closing is not cut off.
Mask padded(const Mask& mask, int frame_px) {
  Mask wide(mask.width_px() + 2 * frame_px, mask.height_px() + 2 * frame_px);
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      if (mask.get(x, y)) wide.set(x + frame_px, y + frame_px);
  return wide;
}

double cover_of(const Mask& mask, const Box& box) {
  constexpr double kGapsClosed = 0.08;  ///< of the height: wider than gaps between twigs
  const int radius_px = std::max(1, static_cast<int>(std::lround(kGapsClosed * box.height())));
  const Mask outline = fill_holes(close_disc(padded(mask, 2 * radius_px), radius_px));
  return static_cast<double>(area_px(mask)) / static_cast<double>(area_px(outline));
}

/// By how the pictures of the species presets and of the bundled targets fall apart: a palm has a high, thin
/// trunk below a crown of few fronds; without leaves less than three quarters of an outline are covered.
TreeKind kind_of(const PictureReading& reading) {
  const bool is_open = reading.cover < 0.745;
  if (is_open && reading.crown_base >= 0.45 && reading.trunk_width < 0.15) return TreeKind::palm;
  return is_open ? TreeKind::leafless : TreeKind::leafy;
}

}  // namespace

PictureReading read_picture(const Mask& mask) {
  const Box box = box_of(mask);
  if (box.bottom < 0) throw_input_error("picture: got an empty mask, expected a tree");
  const double height = box.height();
  const int trunk_px = trunk_width_px(mask, box);
  PictureReading reading;
  reading.height_px = box.height();
  reading.trunk_width = trunk_px / height;
  reading.foot_width = longest_run_px(mask, box.bottom) / height;
  reading.crown_base = bare_height_px(mask, box, trunk_px) / height;
  reading.crown_width = box.width() / height;
  reading.trunks = runs_in_row(mask, foot_row(box));
  reading.cover = cover_of(mask, box);
  reading.touches_frame = box.left == 0 || box.top == 0 || box.right == mask.width_px() - 1;
  reading.kind = kind_of(reading);
  return reading;
}

std::string kind_name(TreeKind kind) {
  constexpr const char* kNames[] = {"leafy", "leafless", "palm"};
  return kNames[static_cast<std::size_t>(kind)];
}

TreeKind kind_by_name(const std::string& name) {
  for (const TreeKind kind : {TreeKind::leafless, TreeKind::palm})
    if (kind_name(kind) == name) return kind;
  return TreeKind::leafy;
}

}  // namespace espalier
