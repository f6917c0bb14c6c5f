// The inside of a closed mesh: rays along the three axes vote. The crossings of an axis ray are found in
// a grid of columns, as points in projected triangles: the projected edge is evaluated from its lower to
// its upper end whatever triangle it belongs to, so that a ray through an edge or a vertex counts exactly
// one of the triangles that meet there (the half-open rule of the crossing-number test; Haines, "Point in
// Polygon Strategies", Graphics Gems IV, 1994). Pure: no state changes, the same bits on every thread.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <espalier/environment/closed_mesh.h>
#include <espalier/environment/mesh_distance.h>
#include <espalier/environment/volume.h>

namespace espalier {

namespace {

/// A point in the frame of an axis: `height` along it, (u, v) across it.
struct AxisPoint {
  float u, v, height;
};

AxisPoint along_axis(Vec3 p, int axis) {
  if (axis == 0) return {p.y, p.z, p.x};
  if (axis == 1) return {p.z, p.x, p.y};
  return {p.x, p.y, p.z};
}

using AxisTriangle = std::array<AxisPoint, 3>;

/// ±1 where the projected edge a→b crosses the half-line from p towards +u, upwards or downwards; else 0.
int edge_crossing(const AxisPoint& a, const AxisPoint& b, const AxisPoint& p) {
  const bool a_above = a.v > p.v, b_above = b.v > p.v;
  if (a_above == b_above) return 0;
  const AxisPoint &low = b_above ? a : b, &high = b_above ? b : a;
  const double side =
      (double{high.u} - low.u) * (double{p.v} - low.v) - (double{p.u} - low.u) * (double{high.v} - low.v);
  if (side <= 0) return 0;
  return b_above ? 1 : -1;
}

/// Twice the signed area of the projected triangle (a, b, p).
double edge_area(const AxisPoint& a, const AxisPoint& b, const AxisPoint& p) {
  return (double{b.u} - a.u) * (double{p.v} - a.v) - (double{b.v} - a.v) * (double{p.u} - a.u);
}

/// The height of the triangle's plane at (p.u, p.v), which its projection covers.
double plane_height(const AxisTriangle& t, const AxisPoint& p) {
  const double w0 = edge_area(t[1], t[2], p), w1 = edge_area(t[2], t[0], p), w2 = edge_area(t[0], t[1], p);
  const auto [lowest, highest] = std::minmax({t[0].height, t[1].height, t[2].height});
  const double sum = w0 + w1 + w2;
  if (sum == 0) return 0.5 * (double{lowest} + highest);  // upright: covered by rounding only
  const double height = (w0 * t[0].height + w1 * t[1].height + w2 * t[2].height) / sum;
  return std::clamp(height, double{lowest}, double{highest});
}

/// ±1 where the ray from p along the axis leaves or enters through the triangle, else 0.
int triangle_crossing(const AxisTriangle& t, const AxisPoint& p) {
  const int winding =
      edge_crossing(t[0], t[1], p) + edge_crossing(t[1], t[2], p) + edge_crossing(t[2], t[0], p);
  return winding != 0 && plane_height(t, p) > p.height ? winding : 0;
}

/// The triangles of a mesh by the columns along one axis that they stand in.
class ColumnGrid {
 public:
  ColumnGrid(const ClosedMesh& mesh, int axis) : axis_(axis) {
    for (const auto& t : mesh.triangles) {
      triangles_.emplace_back();
      for (int i = 0; i < 3; ++i) triangles_.back()[i] = along_axis(mesh.vertices_m[t[i]], axis);
    }
    find_bounds();
    choose_size();
    fill();
    find_most();
  }

  std::size_t most_in_cell() const { return most_in_cell_; }

  /// Sum of the signed crossings of the ray from p, or their number where orientation means nothing.
  int crossings(Vec3 point_m, bool oriented) const {
    const AxisPoint p = along_axis(point_m, axis_);
    if (!(p.u >= lower_.u && p.u <= upper_.u && p.v >= lower_.v && p.v <= upper_.v)) return 0;
    const std::size_t cell = static_cast<std::size_t>(row(p.v)) * size_ + column(p.u);
    int sum = 0;
    for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
      const int crossing = triangle_crossing(triangles_[members_[i]], p);
      sum += oriented ? crossing : std::abs(crossing);
    }
    return sum;
  }

 private:
  struct CellRange {
    int column_0, column_1, row_0, row_1;
    std::size_t count() const { return std::size_t(column_1 - column_0 + 1) * (row_1 - row_0 + 1); }
  };

  int cell_index(float x, float lower, float upper) const {
    const double position = (double{x} - lower) / (double{upper} - lower) * size_;
    return std::clamp(static_cast<int>(position), 0, size_ - 1);
  }
  int column(float u) const { return cell_index(u, lower_.u, upper_.u); }
  int row(float v) const { return cell_index(v, lower_.v, upper_.v); }

  CellRange range_of(const AxisTriangle& t) const {
    const auto [u_0, u_1] = std::minmax({t[0].u, t[1].u, t[2].u});
    const auto [v_0, v_1] = std::minmax({t[0].v, t[1].v, t[2].v});
    return {column(u_0), column(u_1), row(v_0), row(v_1)};
  }

  void find_most() {
    for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell)
      most_in_cell_ = std::max<std::size_t>(most_in_cell_, first_[cell + 1] - first_[cell]);
  }

  void find_bounds() {
    lower_ = upper_ = triangles_.front().front();
    for (const AxisTriangle& t : triangles_)
      for (const AxisPoint& p : t) {
        lower_ = {std::min(lower_.u, p.u), std::min(lower_.v, p.v), 0};
        upper_ = {std::max(upper_.u, p.u), std::max(upper_.v, p.v), 0};
      }
  }

  /// About as many cells as triangles, fewer where long triangles would fill too many of them.
  void choose_size() {
    constexpr std::size_t kCellsPerTriangle = 16;
    size_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(triangles_.size()))), 1, 1024);
    const auto entries = [&] {
      std::size_t sum = 0;
      for (const AxisTriangle& t : triangles_) sum += range_of(t).count();
      return sum;
    };
    while (size_ > 1 && entries() > kCellsPerTriangle * triangles_.size()) size_ /= 2;
  }

  template <typename Visit>
  void for_each_entry(Visit visit) const {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const CellRange range = range_of(triangles_[t]);
      for (int r = range.row_0; r <= range.row_1; ++r)
        for (int c = range.column_0; c <= range.column_1; ++c) visit(std::size_t(r) * size_ + c, t);
    }
  }

  /// Counting sort of the entries by cell.
  void fill() {
    first_.assign(static_cast<std::size_t>(size_) * size_ + 1, 0);
    for_each_entry([&](std::size_t cell, std::uint32_t) { ++first_[cell + 1]; });
    for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
    members_.resize(first_.back());
    std::vector<std::uint32_t> next = first_;
    for_each_entry([&](std::size_t cell, std::uint32_t t) { members_[next[cell]++] = t; });
  }

  int axis_, size_ = 1;
  std::size_t most_in_cell_ = 0;
  AxisPoint lower_{}, upper_{};
  std::vector<AxisTriangle> triangles_;
  std::vector<std::uint32_t> first_, members_;  ///< cell c holds members_[first_[c], first_[c + 1])
};

class MeshVolume final : public Volume {
 public:
  explicit MeshVolume(const ClosedMesh& mesh)
      : oriented_(mesh.oriented),
        distance_(mesh),
        grids_{ColumnGrid(mesh, 2), ColumnGrid(mesh, 0), ColumnGrid(mesh, 1)} {}

  /// As if the triangles that one ray may meet were volumes, several at the price of one.
  VolumeSize size() const override {
    const std::size_t most =
        std::max({grids_[0].most_in_cell(), grids_[1].most_in_cell(), grids_[2].most_in_cell()});
    return {50 + static_cast<double>(most) / 10, 1};
  }

  /// Rays along z and x; where rounding at the surface makes them disagree, y decides.
  bool contains(Vec3 point_m) const override {
    const bool along_z = vote(0, point_m), along_x = vote(1, point_m);
    return along_z == along_x ? along_z : vote(2, point_m);
  }

  float signed_distance_m(Vec3 point_m) const override {
    const float distance_m = distance_.to_surface_m(point_m);
    return contains(point_m) ? -distance_m : distance_m;
  }

 private:
  bool vote(int grid, Vec3 point_m) const {
    const int crossings = grids_[grid].crossings(point_m, oriented_);
    return oriented_ ? crossings != 0 : crossings % 2 != 0;
  }

  bool oriented_;
  MeshDistance distance_;
  std::array<ColumnGrid, 3> grids_;
};

}  // namespace

std::unique_ptr<Volume> make_mesh_volume(const std::filesystem::path& path) {
  return std::make_unique<MeshVolume>(read_closed_mesh(path));
}

}  // namespace espalier
