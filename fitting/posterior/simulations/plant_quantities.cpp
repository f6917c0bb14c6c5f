#include <algorithm>
#include <cmath>
#include <numbers>

#include <espalier/fitting/posterior/simulations/plant_quantities.h>
#include <espalier/plant/leaf_outlines.h>

namespace espalier {

namespace {

constexpr double kBreastHeightM = 1.3;

/// Where the crown is: the leaves, or the knots of the branches of a bare tree, or of its trunks.
std::vector<Vec3> crown_points(const Plant& plant) {
  if (plant.leaves.size() > 0) return plant.leaves.position_m;
  std::vector<Vec3> points;
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    if (plant.stems.level[stem] > 0)
      points.insert(points.end(), plant.knots.point_m.begin() + plant.stems.first_knot[stem],
                    plant.knots.point_m.begin() + plant.stems.first_knot[stem + 1]);
  return points.empty() ? plant.knots.point_m : points;
}

constexpr int kLayers = 16, kSectors = 16;

/// Which of the sectors around the origin the point lies in, counted counter-clockwise: a quadrant, and a
/// quarter of that. Comparisons alone, so that it is the same on every machine.
std::size_t sector_of(double x, double y) {
  constexpr double kTan22 = 0.41421356237309503, kTan67 = 2.414213562373095;  // of 22.5 and 67.5 degrees
  const double right = std::fabs(x), back = std::fabs(y);
  const int from_x_axis = (back > kTan22 * right) + (back > right) + (back > kTan67 * right);
  const int quadrant = y >= 0 ? (x >= 0 ? 0 : 1) : (x < 0 ? 2 : 3);
  return static_cast<std::size_t>(4 * quadrant + (quadrant % 2 == 0 ? from_x_axis : 3 - from_x_axis));
}

/// One layer of a crown: the outline around the middle of its points.
struct CrownLayer {
  double x = 0, y = 0, count = 0;
  std::array<double, kSectors> reach_squared{};

  void add_to_middle(Vec3 point) {
    x += static_cast<double>(point.x), y += static_cast<double>(point.y), count += 1;
  }
  void end_middle() {
    if (count > 0) x /= count, y /= count;
  }
  void add_to_outline(Vec3 point) {
    const double right = static_cast<double>(point.x) - x, back = static_cast<double>(point.y) - y;
    double& farthest = reach_squared[sector_of(right, back)];
    farthest = std::max(farthest, right * right + back * back);
  }
  /// Triangles between the farthest points of neighbouring sectors.
  double area() const {
    double twice = 0;
    for (std::size_t i = 0; i < kSectors; ++i)
      twice += std::sqrt(reach_squared[i] * reach_squared[(i + 1) % kSectors]);
    return 0.5 * std::sin(2 * std::numbers::pi / kSectors) * twice;
  }
};

double crown_volume_m3(std::span<const Vec3> points, double lowest_m, double tall_m) {
  std::array<CrownLayer, kLayers> layers{};
  const auto layer_of = [&](Vec3 point) -> CrownLayer& {
    const double share = (static_cast<double>(point.z) - lowest_m) / tall_m;
    return layers[static_cast<std::size_t>(std::clamp(static_cast<int>(share * kLayers), 0, kLayers - 1))];
  };
  for (const Vec3 point : points) layer_of(point).add_to_middle(point);
  for (CrownLayer& layer : layers) layer.end_middle();
  for (const Vec3 point : points) layer_of(point).add_to_outline(point);
  double area = 0;
  for (const CrownLayer& layer : layers) area += layer.area();
  return area * tall_m / kLayers;
}

/// The fiftieth of the points that lies lowest ends here.
double crown_base_m(std::span<const Vec3> points, double lowest_m) {
  if (points.empty()) return 0;
  std::vector<float> heights;
  heights.reserve(points.size());
  for (const Vec3 point : points) heights.push_back(point.z);
  const auto fiftieth = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 50);
  std::nth_element(heights.begin(), fiftieth, heights.end());
  return std::max(0.0, static_cast<double>(*fiftieth) - lowest_m);
}

/// Frustums between the knots of each stem, which are as long as the straight line.
double wood_volume_m3(const Plant& plant) {
  double volume = 0;
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem)
    for (std::size_t k = plant.stems.first_knot[stem]; k + 1 < plant.stems.first_knot[stem + 1]; ++k) {
      const auto a = static_cast<double>(plant.knots.radius_m[k]),
                 b = static_cast<double>(plant.knots.radius_m[k + 1]);
      const auto along = static_cast<double>(length(plant.knots.point_m[k + 1] - plant.knots.point_m[k]));
      volume += std::numbers::pi / 3 * along * (a * a + a * b + b * b);
    }
  return volume;
}

/// Of the first trunk where it first reaches this height; of its last knot where it never does.
double trunk_radius_m(const Plant& plant, double height_m) {
  if (plant.stems.size() == 0) return 0;
  const std::size_t first = plant.stems.first_knot[0], end = plant.stems.first_knot[1];
  for (std::size_t k = first; k + 1 < end; ++k) {
    const auto below = static_cast<double>(plant.knots.point_m[k].z),
               above = static_cast<double>(plant.knots.point_m[k + 1].z);
    if (above < height_m) continue;
    const double share = above > below ? std::clamp((height_m - below) / (above - below), 0.0, 1.0) : 1;
    return std::lerp(static_cast<double>(plant.knots.radius_m[k]),
                     static_cast<double>(plant.knots.radius_m[k + 1]), share);
  }
  return static_cast<double>(plant.knots.radius_m[end - 1]);
}

}  // namespace

std::vector<double> quantities_of(const Plant& plant, double lowest_m, double tall_m, double height_m) {
  const double scale = height_m / tall_m;
  const double breast_m = std::min(kBreastHeightM, 0.5 * height_m) / scale;
  const std::vector<Vec3> crown = crown_points(plant);
  std::vector<double> quantities = {
      crown_volume_m3(crown, lowest_m, tall_m),
      leaf_area_m2(plant.leaves.length_m, plant.leaves.width_m, plant.leaf_shape),
      wood_volume_m3(plant),
      static_cast<double>(plant.leaves.size()),
      static_cast<double>(plant.stems.size()),
      crown_base_m(crown, lowest_m),
      trunk_radius_m(plant, lowest_m + breast_m)};
  for (std::size_t i = 0; i < quantities.size(); ++i)
    quantities[i] *= std::pow(scale, kPlantQuantities[i].metres);
  return quantities;
}

}  // namespace espalier
