// The seashell as an implicit volume: the tube's helico-spiral [Fowler, Meinhardt, Prusinkiewicz 1992, §3.1]
// is turned back from its parameters to a distance. At the side of the axis where a point lies, the spiral
// passes once a turn; the nearest passage counts, in the half-plane through the axis.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <espalier/core/error.h>
#include <espalier/environment/volume.h>

namespace espalier {

namespace {

class Spiral final : public Volume {
 public:
  explicit Spiral(const SpiralShape& shape) : shape_(shape) {}
  bool contains(Vec3 p) const override { return signed_distance_m(p) <= 0; }

  float signed_distance_m(Vec3 point_m) const override {
    const Vec3 p = point_m - shape_.base_m;
    const double radius_m = std::hypot(p.x, p.y);
    const double side = std::atan2(p.y, p.x) / (2 * std::numbers::pi);  // of a turn
    double nearest_m = std::min(end_distance_m(p, 0), end_distance_m(p, shape_.turns));
    for (double turn = side < 0 ? side + 1 : side; turn <= shape_.turns; turn += 1)
      nearest_m =
          std::min(nearest_m, std::hypot(radius_m - scale(turn) * shape_.radius_m, p.z - height_m(turn)) -
                                  scale(turn) * shape_.tube_radius_m);
    return static_cast<float>(nearest_m);
  }
  /// Each turn takes several powers.
  VolumeSize size() const override { return {6 + 5 * static_cast<double>(shape_.turns), 1}; }

 private:
  double scale(double turn) const { return std::pow(double{shape_.shrink}, turn); }

  double height_m(double turn) const {
    if (shape_.shrink > 0.9999f) return shape_.height_m * turn / shape_.turns;
    return shape_.height_m * (1 - scale(turn)) / (1 - scale(shape_.turns));
  }

  /// The distance to the round end of the tube.
  double end_distance_m(Vec3 p, double turn) const {
    const double angle = 2 * std::numbers::pi * turn, r = scale(turn) * shape_.radius_m;
    return std::hypot(p.x - r * std::cos(angle), p.y - r * std::sin(angle), p.z - height_m(turn)) -
           scale(turn) * shape_.tube_radius_m;
  }

  SpiralShape shape_;
};

void check(const char* what, float number, float upper) {
  if (!(number > 0 && number <= upper))
    throw_input_error("spiral: {} is {}, expected more than 0, at most {}", what, number, upper);
}

}  // namespace

std::unique_ptr<Volume> make_spiral(const SpiralShape& shape) {
  const Vec3 base = shape.base_m;
  if (!std::isfinite(base.x) || !std::isfinite(base.y) || !std::isfinite(base.z))
    throw_input_error("spiral: base is {}, {}, {}, expected finite numbers", base.x, base.y, base.z);
  check("height", shape.height_m, 1e6f);
  check("number of turns", shape.turns, 100);
  check("radius", shape.radius_m, 1e6f);
  check("radius of the tube", shape.tube_radius_m, 1e6f);
  check("shrink", shape.shrink, 1);
  return std::make_unique<Spiral>(shape);
}

}  // namespace espalier
