// A crown envelope in its place: that of a tree, or of a single branch. Metres.
#pragma once
#include <espalier/environment/crown_envelope.h>
#include <espalier/overrides/branch_crown.h>
#include <espalier/weber_penn/scalar/stem.h>

namespace espalier {

class PlacedCrown final : public Volume {
 public:
  /// Where its numbers say.
  explicit PlacedCrown(const CrownShape& shape) : crown_(shape) {}
  /// From the base of a branch to its tip, which must not be the same place. Sides turn with the world: up is
  /// up, but for a branch that is upright, where it is away from the parent.
  PlacedCrown(const BranchCrown& crown, const StemTurtle& base, Vec3 tip_m);

  bool contains(Vec3 point_m) const override { return crown_.contains(own(point_m)); }
  float signed_distance_m(Vec3 point_m) const override {
    return size_m_ * crown_.signed_distance_m(own(point_m));
  }
  bool surely_contains_ball(Vec3 center_m, float radius_m) const override {
    return crown_.surely_contains_ball(own(center_m), radius_m / size_m_);
  }
  /// As CrownEnvelope's.
  float reach_m(Vec3 from_m, Vec3 direction) const {
    return size_m_ * crown_.reach_m(own(from_m), turned(direction));
  }
  const CrownEnvelope& envelope() const { return crown_; }

 private:
  Vec3 turned(Vec3 v) const { return {dot(v, right_), dot(v, up_), dot(v, along_)}; }
  Vec3 own(Vec3 point_m) const { return turned(point_m - base_m_) * (1 / size_m_); }

  CrownEnvelope crown_;
  Vec3 base_m_, right_{1, 0, 0}, up_{0, 1, 0}, along_{0, 0, 1};
  float size_m_ = 1;
};

}  // namespace espalier
