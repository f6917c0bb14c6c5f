// The size of a child stem [Weber & Penn 95, §4.4; CH §3.2.1]. Metres.
#pragma once
#include <algorithm>
#include <cmath>

#include <espalier/weber_penn/scalar/stem.h>

namespace espalier {

constexpr float kShortestStemM = 1e-5f;

/// Stems bear nothing where they are thinner: a tenth of a millimetre [CH §3.2.1] of trees whose twigs are as
/// thick as they are by default, so that a tree of another size is the same tree.
inline float thinnest_parent_m(const WeberPennParameters& p) {
  constexpr float kThinnestM = 1e-6f;  // a stem of no radius has no direction for what it bears
  return std::max(kThinnestM, 0.0001f * (p.least_radius_mm / WeberPennParameters{}.least_radius_mm));
}

/// `parent_radius_m` at the parent's base, `site_radius_m` where the child sits; `level` of the child.
inline float child_radius_m(float length_m, float parent_length_m, float parent_radius_m, float site_radius_m,
                            int level, const WeberPennParameters& p) {
  const float scaled_m = p.radius_mod[level_index(level)] * parent_radius_m *
                         std::pow(length_m / parent_length_m, p.ratio_power);
  return std::min(site_radius_m, std::max(p.least_radius_mm / 1000, scaled_m));
}

/// The longest child relative to this stem; the stem has its level and key.
inline float drawn_child_max(const GrowingStem& stem, const WeberPennParameters& p) {
  const int next = level_index(stem.level + 1);
  const float variation = p.length_v[next];
  return variation == 0 ? p.length[next]
                        : p.length[next] + draw_signed(stem.key, Draw::child_length) * variation;
}

}  // namespace espalier
