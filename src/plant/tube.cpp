// Tubes from polylines: tangents and frames first, then rings, sides and caps. Metres.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <espalier/plant/tube.h>

namespace espalier {

namespace {

constexpr float kPointRadiusM = 1e-5f;

/// One ring of the tube: `side` and `tangent` are unit vectors at a right angle.
struct Ring {
  Vec3 center_m, tangent, side;
  float radius_m, slope;  ///< slope: change of radius per length
  float v;                ///< texture coordinate along the stem

  bool is_point() const { return radius_m < kPointRadiusM; }
};

/// The tangent at each point halves the angle between its chords.
Vec3 tangent_at(const Polyline& line, std::size_t i) {
  const auto& p = line.point_m;
  const Vec3 before = i > 0 ? normalized(p[i] - p[i - 1]) : Vec3{};
  const Vec3 after = i + 1 < p.size() ? normalized(p[i + 1] - p[i]) : Vec3{};
  return normalized(before + after, i > 0 ? before : after);
}

Vec3 reflect(Vec3 x, Vec3 across, float squared_length) {
  return squared_length > 0 ? x - across * (2 / squared_length * dot(across, x)) : x;
}

/// Wang et al. 2008, table I: the side vector of the next ring, made square to its tangent again.
Vec3 transported_side(const Ring& from, Vec3 center_m, Vec3 tangent) {
  const Vec3 chord = center_m - from.center_m;
  const float chord_squared = dot(chord, chord);
  const Vec3 side = reflect(from.side, chord, chord_squared);
  const Vec3 turn = tangent - reflect(from.tangent, chord, chord_squared);
  const Vec3 turned = reflect(side, turn, dot(turn, turn));
  return normalized(turned - tangent * dot(turned, tangent), any_perpendicular(tangent));
}

float slope_at(const Polyline& line, std::size_t i) {
  const std::size_t low = i > 0 ? i - 1 : 0, high = std::min(i + 1, line.size() - 1);
  float length_m = 0;
  for (std::size_t j = low; j < high; ++j) length_m += length(line.point_m[j + 1] - line.point_m[j]);
  return (line.radius_m[high] - line.radius_m[low]) / length_m;
}

std::vector<Ring> make_rings(const Polyline& line) {
  const float thickest_m = *std::max_element(line.radius_m.begin(), line.radius_m.end());
  const float circumference_m = 2 * std::numbers::pi_v<float> * std::max(thickest_m, kPointRadiusM);
  std::vector<Ring> rings;
  rings.reserve(line.size());
  float along_m = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec3 center = line.point_m[i], tangent = tangent_at(line, i);
    if (i > 0) along_m += length(center - line.point_m[i - 1]);
    const Vec3 side = i > 0 ? transported_side(rings.back(), center, tangent) : any_perpendicular(tangent);
    rings.push_back({center, tangent, side, line.radius_m[i], slope_at(line, i), along_m / circumference_m});
  }
  return rings;
}

struct Direction {
  float cos, sin;
};

/// Corners of the regular polygon; the last is the first again, bit for bit.
std::vector<Direction> polygon(int sides) {
  std::vector<Direction> corners;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    corners.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))});
  }
  corners.push_back(corners.front());
  return corners;
}

Vec3 outward(const Ring& ring, Direction d) {
  return ring.side * d.cos + cross(ring.tangent, ring.side) * d.sin;
}

Vec3 position_on(const Ring& ring, Direction d) {
  return ring.is_point() ? ring.center_m : ring.center_m + outward(ring, d) * ring.radius_m;
}

std::uint32_t append_vertex(Vec3 position_m, Vec3 normal, TextureCoordinate texture, TriangleMesh& mesh) {
  mesh.position_m.push_back(position_m);
  mesh.normal.push_back(normal);
  mesh.texture.push_back(texture);
  return static_cast<std::uint32_t>(mesh.position_m.size() - 1);
}

/// Leaves out triangles that have shrunk to an edge, where a ring is a point.
void append_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, TriangleMesh& mesh) {
  const auto& p = mesh.position_m;
  if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return;
  mesh.triangles.push_back({a, b, c});
}

void append_ring(const Ring& ring, const std::vector<Direction>& corners, TriangleMesh& mesh) {
  const float sides = static_cast<float>(corners.size() - 1);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 normal = normalized(outward(ring, corners[k]) - ring.tangent * ring.slope);
    append_vertex(position_on(ring, corners[k]), normal, {static_cast<float>(k) / sides, ring.v}, mesh);
  }
}

/// The sides between the ring that starts at vertex `lower` and the next one.
void append_sides(std::uint32_t lower, std::uint32_t sides, TriangleMesh& mesh) {
  const std::uint32_t upper = lower + sides + 1;
  for (std::uint32_t k = 0; k < sides; ++k) {
    append_triangle(lower + k, lower + k + 1, upper + k + 1, mesh);
    append_triangle(lower + k, upper + k + 1, upper + k, mesh);
  }
}

/// A flat end; `facing` is 1 where it looks along the tangent, -1 at the base.
void append_cap(const Ring& ring, float facing, const std::vector<Direction>& corners, TriangleMesh& mesh) {
  if (ring.is_point()) return;
  const std::uint32_t sides = static_cast<std::uint32_t>(corners.size() - 1);
  std::uint32_t first = 0;
  for (std::uint32_t k = 0; k < sides; ++k) {
    const Direction d = corners[k];
    const std::uint32_t vertex = append_vertex(position_on(ring, d), ring.tangent * facing,
                                               {0.5f + 0.5f * d.cos, 0.5f + 0.5f * d.sin}, mesh);
    if (k == 0) first = vertex;
  }
  for (std::uint32_t k = 1; k + 1 < sides; ++k)
    append_triangle(first, first + (facing > 0 ? k : k + 1), first + (facing > 0 ? k + 1 : k), mesh);
}

}  // namespace

void append_tube(const Polyline& line, int sides, TriangleMesh& mesh) {
  if (line.size() < 2) return;
  const std::vector<Ring> rings = make_rings(line);
  const std::vector<Direction> corners = polygon(sides);
  const auto side_count = static_cast<std::uint32_t>(sides);
  const auto first = static_cast<std::uint32_t>(mesh.position_m.size());
  for (const Ring& ring : rings) append_ring(ring, corners, mesh);
  const auto color_as_ring = [&](std::size_t i) {
    if (!line.color.empty()) mesh.color.resize(mesh.triangles.size(), line.color[i]);
  };
  for (std::uint32_t i = 0; i + 1 < rings.size(); ++i) {
    append_sides(first + i * (side_count + 1), side_count, mesh);
    color_as_ring(i + 1);
  }
  append_cap(rings.front(), -1, corners, mesh);
  color_as_ring(1);
  append_cap(rings.back(), 1, corners, mesh);
  color_as_ring(rings.size() - 1);
}

}  // namespace espalier
