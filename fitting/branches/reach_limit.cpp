#include <algorithm>
#include <cmath>
#include <limits>

#include <espalier/fitting/branches/reach_limit.h>

namespace espalier {

ReachLimit::ReachLimit(const FitTask& task)
    : camera_(task.views[0].camera),
      metres_per_px_(task.views[0].metres_per_px),
      base_depth_m_(project(camera_, {0, 0, 0}).depth_m) {
  constexpr double kLeast = 0.15;  // of the height, where the picture is of a pole
  const PictureReading& reading = task.views[0].reading;
  const double half_px = std::max(0.6 * reading.crown_width, kLeast) * reading.height_px;
  half_depth_m_ = task.views.size() > 1 ? std::numeric_limits<float>::infinity()
                                        : static_cast<float>(half_px) * metres_per_px_;
}

/// How far from the frame.
float ReachLimit::outside_px(const PicturePoint& seen) const {
  const auto beyond = [](float x, int size) { return std::max({0.f, -x, x - static_cast<float>(size)}); };
  return std::max(beyond(seen.x_px, camera_.width_px), beyond(seen.y_px, camera_.height_px));
}

float ReachLimit::excess_m(const Plant& plant) const {
  float most_m = 0;
  for (const Vec3 point_m : plant.knots.point_m) {
    const PicturePoint seen = project(camera_, point_m);
    const float too_deep_m = std::fabs(seen.depth_m - base_depth_m_) - half_depth_m_;
    most_m = std::max({most_m, too_deep_m, outside_px(seen) * metres_per_px_});
  }
  return most_m;
}

}  // namespace espalier
