#include <algorithm>
#include <cmath>

#include <espalier/fitting/task/wood_share.h>

namespace espalier {

double branch_area_m2(const Plant& plant) {
  double area = 0;
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    if (plant.stems.level[stem] == 0) continue;
    for (std::size_t k = plant.stems.first_knot[stem]; k + 1 < plant.stems.first_knot[stem + 1]; ++k) {
      const Vec3 along = plant.knots.point_m[k + 1] - plant.knots.point_m[k];
      area += static_cast<double>(std::sqrt(dot(along, along)) *
                                  (plant.knots.radius_m[k] + plant.knots.radius_m[k + 1]));
    }
  }
  return area;
}

double wood_share(double branch_area_m2, double leaf_area_m2) {
  const double all = branch_area_m2 + leaf_area_m2;
  return all > 0 ? branch_area_m2 / all : 0;
}

double wood_excess(double wood_share) {
  constexpr double kUsual =
      0.12;  // of 16 species .05 to .22, .07 in the median; the cherry in blossom left out
  return std::max(0.0, wood_share - kUsual);
}

}  // namespace espalier
