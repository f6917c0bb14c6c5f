#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <espalier/image/masks/convex_hull.h>

namespace espalier {

namespace geometry = boost::geometry;

double convex_hull_area_px(const Mask& mask) {
  using Point = geometry::model::d2::point_xy<double>;
  geometry::model::multi_point<Point> corners;  // of the first and the last pixel of each row
  for (int y = 0; y < mask.height_px(); ++y) {
    int first = 0, last = mask.width_px() - 1;
    while (first <= last && !mask.get(first, y)) ++first;
    while (last > first && !mask.get(last, y)) --last;
    if (first > last) continue;
    for (const int row : {y, y + 1})
      for (const int column : {first, last + 1}) corners.emplace_back(column, row);
  }
  if (corners.empty()) return 0;
  geometry::model::polygon<Point> hull;
  geometry::convex_hull(corners, hull);
  return geometry::area(hull);
}

}  // namespace espalier
