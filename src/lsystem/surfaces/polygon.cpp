#include <espalier/lsystem/surfaces/polygon.h>

namespace espalier::lsystem {

namespace {

Vec3 newell_normal(std::span<const Vec3> vertices) {
  Vec3 normal;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    normal += cross(vertices[i] - vertices[0], vertices[(i + 1) % vertices.size()] - vertices[0]);
  return normalized(normal);
}

double turn(Vec3 a, Vec3 b, Vec3 c, Vec3 normal) { return dot(cross(b - a, c - a), normal); }

bool is_inside(Vec3 p, const Triangle& t, Vec3 normal) {
  return turn(t[0], t[1], p, normal) >= 0 && turn(t[1], t[2], p, normal) >= 0 &&
         turn(t[2], t[0], p, normal) >= 0;
}

bool is_ear(const std::vector<Vec3>& rest, std::size_t i, Vec3 normal, Work& work) {
  const std::size_t n = rest.size(), before = (i + n - 1) % n, after = (i + 1) % n;
  const Triangle triangle{rest[before], rest[i], rest[after]};
  work.add(work_of::kCorner);
  if (turn(triangle[0], triangle[1], triangle[2], normal) <= 0) return false;
  work.add(work_of::kCorner * static_cast<double>(n));
  for (std::size_t k = 0; k < n; ++k) {
    if (k == before || k == i || k == after) continue;
    const bool same = rest[k] == rest[before] || rest[k] == rest[i] || rest[k] == rest[after];
    if (!same && is_inside(rest[k], triangle, normal)) return false;
  }
  return true;
}

}  // namespace

void triangulate(std::span<const Vec3> vertices, std::vector<Triangle>& triangles, Work& work) {
  std::vector<Vec3> rest;
  for (const Vec3 vertex : vertices)  // an outline that returns to its start closes itself
    if (rest.empty() || length(vertex - rest.back()) > 1e-6f) rest.push_back(vertex);
  while (rest.size() > 1 && length(rest.front() - rest.back()) <= 1e-6f) rest.pop_back();
  const Vec3 normal = newell_normal(rest);
  while (rest.size() >= 3) {
    std::size_t ear = 0;
    while (ear < rest.size() && !is_ear(rest, ear, normal, work)) ++ear;
    if (ear == rest.size()) ear = 0;  // three points in a line, or an outline that crosses itself
    const std::size_t n = rest.size();
    triangles.push_back({rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
}

}  // namespace espalier::lsystem
