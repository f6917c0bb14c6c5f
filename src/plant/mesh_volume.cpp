#include <algorithm>
#include <cmath>

#include <espalier/plant/mesh_volume.h>

namespace espalier {

namespace {

struct ColumnPoint {
  double x, y, z;
};

using ColumnTriangle = std::array<ColumnPoint, 3>;

ColumnTriangle corners_of(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  ColumnTriangle corners{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& p = mesh.position_m[triangle[i]];
    corners[i] = {p.x, p.y, p.z};
  }
  return corners;
}

/// Twice the area of the triangle seen from above; positive where it faces upwards.
double doubled_area(const ColumnTriangle& c) {
  return (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
}

/// Where a surface crosses a column: upwards, into the open, -1; from below, into the inside, +1.
struct Crossing {
  std::int64_t column;
  float z_m;
  std::int8_t winding;
};

/// The columns whose middles lie in a triangle seen from above. Edges belong to the triangle on one side
/// alone, by the sign of their direction, so that columns through the edge of two are crossed once.
class Columns {
 public:
  explicit Columns(double side_m) : side_m_(side_m) {}

  void cross(const ColumnTriangle& c) {
    const double area = doubled_area(c);
    if (area == 0) return;
    const auto [low_x, high_x] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [low_y, high_y] = std::minmax({c[0].y, c[1].y, c[2].y});
    for (std::int64_t i = first(low_x); middle(i) <= high_x; ++i)
      for (std::int64_t j = first(low_y); middle(j) <= high_y; ++j) add(c, area, i, j);
  }

  MeshVolume volume() {
    std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
      return a.column != b.column ? a.column < b.column : a.z_m < b.z_m;
    });
    double sum_m = 0, union_m = 0;
    int depth = 0;
    for (std::size_t k = 0; k + 1 < crossings_.size(); ++k) {
      const Crossing &here = crossings_[k], &next = crossings_[k + 1];
      depth += here.winding;
      if (here.column != next.column) {
        depth = 0;
        continue;
      }
      const double length_m = static_cast<double>(next.z_m) - here.z_m;
      sum_m += depth * length_m;
      if (depth > 0) union_m += length_m;
    }
    return {sum_m * side_m_ * side_m_, union_m * side_m_ * side_m_, side_m_};
  }

 private:
  std::int64_t first(double low) const { return static_cast<std::int64_t>(std::ceil(low / side_m_ - 0.5)); }
  double middle(std::int64_t i) const { return (static_cast<double>(i) + 0.5) * side_m_; }

  void add(const ColumnTriangle& c, double area, std::int64_t i, std::int64_t j) {
    const double x = middle(i), y = middle(j);
    double z = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const ColumnPoint &a = c[(k + 1) % 3], &b = c[(k + 2) % 3];
      const double share = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
      if (share < 0 || (share == 0 && !owns_edge(a, b, area))) return;
      z += share * c[k].z;
    }
    crossings_.push_back(
        {(i << 32) ^ (j & 0xffffffff), static_cast<float>(z), static_cast<std::int8_t>(area > 0 ? -1 : 1)});
  }

  static bool owns_edge(const ColumnPoint& a, const ColumnPoint& b, double area) {
    const double dx = area > 0 ? b.x - a.x : a.x - b.x, dy = area > 0 ? b.y - a.y : a.y - b.y;
    return dy > 0 || (dy == 0 && dx > 0);
  }

  double side_m_;
  std::vector<Crossing> crossings_;
};

}  // namespace

MeshVolume measure_volume(const TriangleMesh& mesh, std::size_t crossings) {
  double seen_m2 = 0;
  for (const auto& triangle : mesh.triangles)
    seen_m2 += std::fabs(doubled_area(corners_of(mesh, triangle))) / 2;
  if (seen_m2 == 0) return {};
  Columns columns(std::sqrt(seen_m2 / static_cast<double>(crossings)));
  for (const auto& triangle : mesh.triangles) columns.cross(corners_of(mesh, triangle));
  return columns.volume();
}

}  // namespace espalier
