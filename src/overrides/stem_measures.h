// Places, directions and lengths along the stems of a plant. A place is met again on the same stem in another
// shape: measure in one set of knots, look it up in the other.
#pragma once
#include <vector>

#include <espalier/plant/joints.h>

namespace espalier {

/// The point at a place of the stem, in `knots` that are numbered as the plant's.
Vec3 point_at(const Stems& stems, const Knots& knots, std::size_t stem, StemPlace place);
/// The unit vector along the stem there.
Vec3 direction_at(const Stems& stems, const Knots& knots, std::size_t stem, StemPlace place);

/// How far along their stems a plant's knots are.
class ArcLengths {
 public:
  explicit ArcLengths(const Plant& plant);

  float of_stem_m(const Stems& stems, std::size_t stem) const;
  float at_knot_m(std::size_t knot) const { return at_knot_m_[knot]; }
  /// 0 at the stem's base to 1 at its tip.
  float fraction_at(const Stems& stems, std::size_t stem, StemPlace place) const;
  StemPlace place_at(const Stems& stems, std::size_t stem, float fraction) const;

 private:
  std::vector<float> at_knot_m_;
};

}  // namespace espalier
