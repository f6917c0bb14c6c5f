// One segment of a stem in a picture: its curve, projected and cut into cones. Pixels.
#pragma once
#include <espalier/image/masks/mask.h>
#include <espalier/plant/plant.h>
#include <espalier/render/camera.h>

namespace espalier {

constexpr float kStemTolerancePx = 0.125f;  ///< of silhouettes of curves
constexpr float kMostCones = 64;            ///< of a segment

/// Draws segments of a plant's stems, in any projection.
class StemPen {
 public:
  /// Both must outlive the pen.
  StemPen(const Plant& plant, const Camera& camera) : knots_(plant.knots), camera_(camera) {}

  /// The segment from knot k to knot k + 1.
  void draw_segment(std::size_t k, Mask& mask) const;

 private:
  const Knots& knots_;
  const Camera& camera_;
};

}  // namespace espalier
