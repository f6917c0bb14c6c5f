#include <algorithm>

#include <espalier/environment/leaves_inside.h>

namespace espalier {

namespace {

constexpr float kWithin = 0.75f;  ///< of a leaf, or outlines would be bare where stems end

/// Judged by a point near its tip and by its middle's two ends, where the outlines of leaves are widest.
bool fits(const Volume& volume, const Leaves& leaves, std::size_t i, float scale) {
  const Vec3 along = leaves.axis[i] * (scale * kWithin * leaves.length_m[i]);
  const Vec3 across = leaves.side[i] * (0.5f * scale * kWithin * leaves.width_m[i]);
  const Vec3 middle_m = leaves.position_m[i] + along * 0.5f;
  const float reach_m = 0.5f * scale * std::max(leaves.length_m[i], leaves.width_m[i]);
  if (volume.surely_contains_ball(middle_m, 1.2f * reach_m)) return true;
  return volume.contains(leaves.position_m[i] + along) && volume.contains(middle_m + across) &&
         volume.contains(middle_m - across);
}

/// The share of its size at which the leaf fits, or 0.
float fitting_scale(const Volume& volume, const Leaves& leaves, std::size_t i) {
  for (const float scale : {1.f, 0.75f, 0.5f})
    if (fits(volume, leaves, i, scale)) return scale;
  return 0;
}

}  // namespace

void keep_leaves_inside(const Volume& volume, Leaves& leaves) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const float scale = fitting_scale(volume, leaves, i);
    if (scale == 0) continue;
    leaves.position_m[kept] = leaves.position_m[i];
    leaves.axis[kept] = leaves.axis[i];
    leaves.side[kept] = leaves.side[i];
    leaves.length_m[kept] = scale * leaves.length_m[i];
    leaves.width_m[kept] = scale * leaves.width_m[i];
    leaves.kind[kept] = leaves.kind[i];
    ++kept;
  }
  leaves.position_m.resize(kept), leaves.axis.resize(kept), leaves.side.resize(kept);
  leaves.length_m.resize(kept), leaves.width_m.resize(kept), leaves.kind.resize(kept);
}

}  // namespace espalier
