#include <espalier/weber_penn/placed_crown.h>

namespace espalier {

namespace {

/// From (0, 0, 0) to (0, 0, 1).
CrownShape unit_shape(const BranchCrown& crown) {
  return {.radius_m = crown.radius,
          .rim_m = crown.rim,
          .shape_above = crown.shape_tip,
          .shape_below = crown.shape_base};
}

}  // namespace

PlacedCrown::PlacedCrown(const BranchCrown& crown, const StemTurtle& base, Vec3 tip_m)
    : crown_(unit_shape(crown)), base_m_(base.position_m) {
  size_m_ = length(tip_m - base_m_);
  along_ = normalized(tip_m - base_m_, base.forward);
  constexpr float kUpright = 0.01f;  // sine of the angle to the vertical
  const Vec3 across = cross(along_, {0, 0, 1});
  right_ = length(across) > kUpright ? normalized(across) : any_perpendicular(along_);
  if (length(across) <= kUpright) {
    const Vec3 side = base.right - along_ * dot(base.right, along_);
    right_ = normalized(side, right_);
  }
  up_ = cross(right_, along_);
}

}  // namespace espalier
