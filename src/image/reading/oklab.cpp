#include <cmath>

#include <espalier/image/reading/oklab.h>

namespace espalier {

namespace {

/// IEC 61966-2-1.
double linear_of(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

}  // namespace

Eigen::Vector3d oklab_of(const Eigen::Vector3d& srgb) {
  const Eigen::Matrix3d cones{{0.4122214708, 0.5363325363, 0.0514459929},
                              {0.2119034982, 0.6806995451, 0.1073969566},
                              {0.0883024619, 0.2817188376, 0.6299787005}};
  const Eigen::Matrix3d opponents{{0.2104542553, 0.7936177850, -0.0040720468},
                                  {1.9779984951, -2.4285922050, 0.4505937099},
                                  {0.0259040371, 0.7827717662, -0.8086757660}};
  const Eigen::Vector3d response = cones * srgb.unaryExpr(&linear_of);
  return opponents * response.unaryExpr([](double value) { return std::cbrt(value); });
}

}  // namespace espalier
