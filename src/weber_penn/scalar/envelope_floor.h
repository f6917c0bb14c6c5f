// A floor under the pruning envelope, by a table: most stems lie well inside of it, and that is seen without
// the envelope's powers. Metres. Equations as in shape_ratio.h.
#pragma once
#include <array>

#include <espalier/core/vec3.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier {

class EnvelopeFloor {
 public:
  explicit EnvelopeFloor(const WeberPennParameters& parameters);

  /// True only where ball_inside_envelope is, within its rounding; false also for some balls that are inside.
  bool surely_holds_ball(Vec3 center_m, float radius_m, float tree_scale_m) const;

 private:
  static constexpr int kCells = 128;
  float at(float z_m, float tree_scale_m) const;

  float crown_share_;  ///< of the tree's height
  /// Least radius, relative to the tree's height, in each part of the crown from its top down.
  std::array<float, kCells> radius_;
};

}  // namespace espalier
