#include <algorithm>
#include <cmath>

#include <espalier/weber_penn/scalar/envelope_floor.h>
#include <espalier/weber_penn/table/shape_ratio.h>

namespace espalier {

// The envelope widens from the top down to its peak, then narrows: in no cell, nor between two, is it
// narrower than at their ends.
EnvelopeFloor::EnvelopeFloor(const WeberPennParameters& p) : crown_share_(1 - p.base_size[0]) {
  const auto radius_at = [&](int end) {
    return p.prune_width * shape_ratio(8, static_cast<float>(end) / kCells, p);
  };
  constexpr float kRounding = 0.9999f;
  for (int cell = 0; cell < kCells; ++cell)
    radius_[static_cast<std::size_t>(cell)] = kRounding * std::min(radius_at(cell), radius_at(cell + 1));
}

/// 0 above and below the crown.
float EnvelopeFloor::at(float z_m, float tree_scale_m) const {
  const float cell = (tree_scale_m - z_m) / (tree_scale_m * crown_share_) * kCells;
  return cell >= 0 && cell < kCells ? radius_[static_cast<std::size_t>(cell)] : 0;
}

bool EnvelopeFloor::surely_holds_ball(Vec3 center_m, float radius_m, float tree_scale_m) const {
  const float distance_m = std::sqrt(center_m.x * center_m.x + center_m.y * center_m.y);
  const float reach = (distance_m + radius_m) / tree_scale_m;
  return reach < std::min(at(center_m.z - radius_m, tree_scale_m), at(center_m.z + radius_m, tree_scale_m));
}

}  // namespace espalier
