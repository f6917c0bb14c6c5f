// How the children of a stem spread along it: evenly, or as a density says above its bare base, with as many
// there in all. What would grow below stays evenly spread, and is left out as ever. Shares and places are
// from 0 to 1 along the whole stem.
#pragma once
#include <algorithm>

#include <espalier/weber_penn/table/parameters.h>

namespace espalier {

class ChildSpacing {
 public:
  ChildSpacing(const DensityCurve& density, float bare)
      : density_(&density), bare_(bare), per_crown_(1 / (1 - bare)) {}

  bool is_even() const { return density_->is_neutral; }

  /// Share of the children below z.
  float share_below(float z) const {
    return z <= bare_ ? z : bare_ + (1 - bare_) * density_->share_below((z - bare_) * per_crown_);
  }
  /// Its inverse.
  float place_of(float share) const {
    return share < bare_ ? share : bare_ + (1 - bare_) * density_->place_of((share - bare_) * per_crown_);
  }

  /// A part of the stem, and the shares of the children below its ends.
  struct Part {
    float z_start = 0, per_length = 1, share_start = 0, share_end = 1;
    float share() const { return share_end - share_start; }
  };
  Part part_of(float z_start, float z_end) const {
    return {z_start, 1 / (z_end - z_start), share_below(z_start), share_below(z_end)};
  }
  Part part_of(int segment, int segments) const {
    const auto z = [&](int at) { return static_cast<float>(at) / static_cast<float>(segments); };
    return part_of(z(segment), z(segment + 1));
  }
  /// Where along the part, from 0 to 1, this share of its own children is below.
  float along(const Part& part, float share) const {
    const float z = place_of(part.share_start + share * part.share());
    return std::clamp((z - part.z_start) * part.per_length, 0.f, 1.f);
  }

 private:
  const DensityCurve* density_;
  float bare_, per_crown_;
};

/// Of the stems on a stem of this level.
inline ChildSpacing stem_spacing(int level, const WeberPennParameters& p) {
  return {p.curves.density_along[static_cast<std::size_t>(level_index(level + 1))],
          p.base_size[static_cast<std::size_t>(level_index(level))]};
}

/// Of the leaves on a stem of this level.
inline ChildSpacing leaf_spacing(int level, const WeberPennParameters& p) {
  return {p.curves.leaf_density_along, p.base_size[static_cast<std::size_t>(level_index(level))]};
}

}  // namespace espalier
