// Roots that spread above the ground: a trunk that stands on two or more feet. Its base is between them,
// where the lowest pixels are those of one foot alone.
#pragma once
#include <optional>

#include <espalier/image/masks/mask.h>
#include <espalier/image/masks/mask_box.h>
#include <espalier/image/masks/row_runs.h>

namespace espalier {

struct Roots {
  int fork_row = 0;  ///< the highest row of separate feet; above it they are one trunk
  RowRun trunk;      ///< where it is narrowest, a little above
  int width_px = 0;  ///< of the feet and what is between them
};

/// The roots in a mask that is set in `box` and nowhere else; none where the trunk has one foot, or where
/// what joins the feet is no trunk but a crown that hangs down.
std::optional<Roots> roots_of(const Mask& mask, const MaskBox& box);

/// The mask whose trunk goes straight down to the lowest row instead of forking into roots.
Mask without_roots(Mask mask);

}  // namespace espalier
