// Crown shapes and the pruning envelope, see shape_ratio.h.
#include <array>
#include <cmath>
#include <numbers>

#include <espalier/weber_penn/table/shape_ratio.h>

namespace espalier {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
using Shape = float (*)(float ratio);

float peaked_at_07(float r) { return r <= 0.7f ? r / 0.7f : (1 - r) / 0.3f; }

const std::array<Shape, 8> kShapes = {
    [](float r) { return 0.2f + 0.8f * r; },                         // conical
    [](float r) { return 0.2f + 0.8f * std::sin(kPi * r); },         // spherical
    [](float r) { return 0.2f + 0.8f * std::sin(0.5f * kPi * r); },  // hemispherical
    [](float) { return 1.0f; },                                      // cylindrical
    [](float r) { return 0.5f + 0.5f * r; },                         // tapered cylindrical
    peaked_at_07,                                                    // flame
    [](float r) { return 1 - 0.8f * r; },                            // inverse conical
    [](float r) { return 0.5f + 0.5f * peaked_at_07(r); },           // tend flame
};

/// Shape 8. The lower branch divides by 1 − prune_width_peak as the published implementation does, where
/// Weber and Penn divide by prune_width_peak: the species values were tuned for the former.
float envelope_ratio(float r, const WeberPennParameters& parameters) {
  if (r < 0 || r > 1) return 0;
  const float upper_part = 1 - parameters.prune_width_peak;
  if (r < upper_part) return std::pow(r / upper_part, parameters.prune_power_high);
  if (upper_part <= 0) return r < 1 ? 1.f : 0.f;
  return std::pow((1 - r) / upper_part, parameters.prune_power_low);
}

/// Where in the crown a height in the tree is: 0 at the crown's top, 1 at its base.
float crown_ratio(float z_m, float tree_scale_m, const WeberPennParameters& parameters) {
  return (tree_scale_m - z_m) / (tree_scale_m * (1 - parameters.base_size[0]));
}

}  // namespace

float shape_ratio(int shape, float ratio, const WeberPennParameters& parameters) {
  return shape < 8 ? kShapes[shape](ratio) : envelope_ratio(ratio, parameters);
}

float crown_shape_ratio(float ratio, const WeberPennParameters& parameters) {
  const float first = shape_ratio(static_cast<int>(parameters.shape), ratio, parameters);
  if (parameters.shape_mix == 0) return first;
  const float second = shape_ratio(static_cast<int>(parameters.shape_2), ratio, parameters);
  return first + parameters.shape_mix * (second - first);
}

bool inside_envelope(Vec3 point_m, float tree_scale_m, const WeberPennParameters& parameters) {
  const float distance = std::hypot(point_m.x, point_m.y);
  const float ratio = crown_ratio(point_m.z, tree_scale_m, parameters);
  return distance / tree_scale_m < parameters.prune_width * shape_ratio(8, ratio, parameters);
}

// From the top down the envelope widens to its peak, then narrows: between two heights it is nowhere narrower
// than at the narrower one.
bool ball_inside_envelope(Vec3 center_m, float radius_m, float tree_scale_m,
                          const WeberPennParameters& parameters) {
  const float reach = (std::hypot(center_m.x, center_m.y) + radius_m) / tree_scale_m;
  const auto is_inside_at = [&](float z_m) {
    const float ratio = crown_ratio(z_m, tree_scale_m, parameters);
    return reach < parameters.prune_width * shape_ratio(8, ratio, parameters);
  };
  return is_inside_at(center_m.z - radius_m) && is_inside_at(center_m.z + radius_m);
}

}  // namespace espalier
