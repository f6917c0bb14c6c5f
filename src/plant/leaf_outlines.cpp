// Leaves are drawn as their right half from stalk to tip, mirrored, and cut into triangles by clipping
// ears; blossoms as petals of three triangles around the y axis. Unit length, no unit.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <span>

#include <espalier/core/error.h>
#include <espalier/plant/leaf_outlines.h>

namespace espalier {

namespace {

struct Point {
  float x, y;
};

using Half = std::vector<Point>;
using Corners = std::vector<std::uint32_t>;

const Half kOvate{{0, 0}, {0.127f, 0.06f}, {0.25f, 0.25f}, {0.216f, 0.45f}, {0.09f, 0.72f}, {0, 1}};
const Half kLinear{{0, 0}, {0.058f, 0.06f}, {0.1f, 0.2f}, {0.1f, 0.8f}, {0.058f, 0.93f}, {0, 1}};
const Half kCordate{{0, 0},         {0.004f, 0.12f}, {0.105f, 0.03f}, {0.276f, 0.12f},
                    {0.35f, 0.28f}, {0.248f, 0.5f},  {0.067f, 0.78f}, {0, 1}};
const Half kMaple{{0, 0},         {0.008f, 0.14f}, {0.233f, 0.04f}, {0.212f, 0.16f},
                  {0.5f, 0.3f},   {0.408f, 0.36f}, {0.477f, 0.58f}, {0.318f, 0.56f},
                  {0.171f, 0.5f}, {0.212f, 0.7f},  {0.103f, 0.74f}, {0, 1}};
const Half kPalmate{{0, 0},          {0.002f, 0.12f}, {0.228f, 0.02f}, {0.142f, 0.16f},
                    {0.5f, 0.28f},   {0.355f, 0.42f}, {0.142f, 0.4f},  {0.355f, 0.78f},
                    {0.183f, 0.74f}, {0.049f, 0.5f},  {0.056f, 0.8f},  {0, 1}};
const Half kSpikyOak{{0, 0},         {0.016f, 0.12f}, {0.145f, 0.1f}, {0.093f, 0.22f},
                     {0.295f, 0.3f}, {0.145f, 0.4f},  {0.32f, 0.56f}, {0.145f, 0.62f},
                     {0.223f, 0.8f}, {0.074f, 0.82f}, {0, 1}};
const Half kRoundedOak{{0, 0},          {0.024f, 0.12f}, {0.096f, 0.14f}, {0.118f, 0.22f}, {0.075f, 0.28f},
                       {0.18f, 0.36f},  {0.194f, 0.46f}, {0.118f, 0.52f}, {0.236f, 0.6f},  {0.25f, 0.72f},
                       {0.155f, 0.78f}, {0.167f, 0.9f},  {0.065f, 0.98f}, {0, 1}};
const Half kElliptic{{0, 0},          {0.095f, 0.14f}, {0.207f, 0.32f}, {0.25f, 0.5f},
                     {0.207f, 0.68f}, {0.095f, 0.86f}, {0, 1}};
const Half kRectangle{{0, 0}, {0.5f, 0}, {0.5f, 1}, {0, 1}};
const Half kTriangle{{0, 0}, {0.5f, 0}, {0, 1}};

/// The whole boundary. A stalk or tip in the middle of a straight edge is no corner and is left out.
std::vector<Vec3> mirrored(const Half& half) {
  std::vector<Vec3> boundary;
  const bool flat_foot = half[1].y == half.front().y, flat_tip = half[half.size() - 2].y == half.back().y;
  for (std::size_t i = flat_foot ? 1 : 0; i < half.size() - (flat_tip ? 1 : 0); ++i)
    boundary.push_back({half[i].x, half[i].y, 0});
  for (std::size_t i = half.size() - 2; i >= 1; --i) boundary.push_back({-half[i].x, half[i].y, 0});
  return boundary;
}

/// Twice the signed area of the triangle, positive where it turns left.
float turn(Vec3 a, Vec3 b, Vec3 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

bool is_inside(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

/// Corner i can be cut off: it is convex and no other corner lies in its triangle.
bool is_ear(std::span<const Vec3> vertices, const Corners& rest, std::size_t i) {
  const std::size_t n = rest.size();
  const std::uint32_t a = rest[(i + n - 1) % n], b = rest[i], c = rest[(i + 1) % n];
  if (turn(vertices[a], vertices[b], vertices[c]) <= 0) return false;
  for (const std::uint32_t other : rest)
    if (other != a && other != b && other != c &&
        is_inside(vertices[other], vertices[a], vertices[b], vertices[c]))
      return false;
  return true;
}

/// Triangles of a simple counter-clockwise polygon, by clipping ears (Meisters 1975).
std::vector<std::array<std::uint32_t, 3>> triangulated(std::span<const Vec3> vertices) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Corners rest(vertices.size());
  std::iota(rest.begin(), rest.end(), 0u);
  while (rest.size() > 3) {
    std::size_t ear = 0;
    while (ear < rest.size() && !is_ear(vertices, rest, ear)) ++ear;
    if (ear == rest.size()) throw InternalError("a leaf outline crosses itself");
    const std::size_t n = rest.size();
    triangles.push_back({rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({rest[0], rest[1], rest[2]});
  return triangles;
}

LeafOutline leaf_from_half(const Half& half) {
  LeafOutline outline;
  outline.vertices = mirrored(half);
  outline.triangles = triangulated(outline.vertices);
  return outline;
}

/// A ring of points of a petal: distance from the axis, height, half its angle.
struct PetalRing {
  float radius, height, half_angle_deg;
};

/// A cup of petals: each is a fan from the origin to its waist, and a band from there to its rim.
struct Cup {
  int petals;
  PetalRing waist, rim;
};

constexpr Cup kCherry{5, {0.42f, 0.22f, 34}, {0.65f, 0.50f, 20}};
constexpr Cup kOrange{5, {0.32f, 0.26f, 26}, {0.66f, 0.55f, 7}};
constexpr Cup kMagnolia{6, {0.45f, 0.30f, 33}, {0.65f, 0.70f, 10}};

Vec3 on_ring(const PetalRing& ring, float middle_deg, float side) {
  const float angle = (middle_deg + side * ring.half_angle_deg) * std::numbers::pi_v<float> / 180;
  return {ring.radius * std::sin(angle), ring.height, ring.radius * std::cos(angle)};
}

LeafOutline blossom_from_cup(const Cup& cup) {
  LeafOutline outline;
  outline.vertices.push_back({0, 0, 0});
  for (int petal = 0; petal < cup.petals; ++petal) {
    const float middle_deg = 360.0f * static_cast<float>(petal) / static_cast<float>(cup.petals) + 90;
    const auto first = static_cast<std::uint32_t>(outline.vertices.size());
    for (const PetalRing& ring : {cup.waist, cup.rim})
      for (const float side : {-1.0f, 1.0f}) outline.vertices.push_back(on_ring(ring, middle_deg, side));
    outline.triangles.push_back({0, first, first + 1});
    outline.triangles.push_back({first, first + 2, first + 3});
    outline.triangles.push_back({first, first + 3, first + 1});
  }
  return outline;
}

const LeafOutline& one_of(std::span<const LeafOutline> outlines, int shape, const char* what) {
  if (shape < 1 || shape > static_cast<int>(outlines.size()))
    throw InternalError(fmt::format("{} is {}, expected 1..{}", what, shape, outlines.size()));
  return outlines[static_cast<std::size_t>(shape - 1)];
}

constexpr int kEllipticShape = 8;

// In the order of their names.
const Half* const kHalves[] = {&kOvate,    &kLinear,     &kCordate,  &kMaple,     &kPalmate,
                               &kSpikyOak, &kRoundedOak, &kElliptic, &kRectangle, &kTriangle};
const Cup* const kCups[] = {&kCherry, &kOrange, &kMagnolia};
static_assert(std::size(kHalves) == kLeafShapes.size() && std::size(kCups) == kBlossomShapes.size());

std::vector<LeafOutline> all_leaves() {
  std::vector<LeafOutline> outlines;
  for (const Half* half : kHalves) outlines.push_back(leaf_from_half(*half));
  return outlines;
}

std::vector<LeafOutline> all_blossoms() {
  std::vector<LeafOutline> outlines;
  for (const Cup* cup : kCups) outlines.push_back(blossom_from_cup(*cup));
  return outlines;
}

/// Of a flat outline, at unit size.
double area_of(const LeafOutline& outline) {
  double area = 0;
  for (const auto& [a, b, c] : outline.triangles) {
    const Vec3 u = outline.vertices[b] - outline.vertices[a], v = outline.vertices[c] - outline.vertices[a];
    area += 0.5 * std::fabs(static_cast<double>(u.x * v.y - u.y * v.x));
  }
  return area;
}

}  // namespace

const LeafOutline& leaf_outline(int shape) {
  static const std::vector<LeafOutline> outlines = all_leaves();
  return one_of(outlines, shape == 0 ? kEllipticShape : shape, "leaf_shape");
}

double leaf_area_m2(std::span<const float> lengths_m, std::span<const float> widths_m, int shape) {
  double boxes = 0;
  for (std::size_t i = 0; i < lengths_m.size(); ++i)
    boxes += static_cast<double>(lengths_m[i]) * static_cast<double>(widths_m[i]);
  return boxes * area_of(leaf_outline(shape));
}

const LeafOutline& blossom_outline(int shape) {
  static const std::vector<LeafOutline> outlines = all_blossoms();
  return one_of(outlines, shape, "blossom_shape");
}

}  // namespace espalier
