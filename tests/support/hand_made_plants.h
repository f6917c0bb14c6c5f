// Plants made by hand for laws of rendering and for speed: a few stems and leaves of known size. Metres.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include <espalier/core/random.h>
#include <espalier/plant/plant.h>

namespace espalier {

/// A stem through the points with the radii: straight segments, handles at thirds.
inline void add_stem(Plant& plant, std::span<const Vec3> points_m, std::span<const float> radii_m,
                     int level = 0) {
  if (plant.stems.first_knot.empty()) plant.stems.first_knot.push_back(0);
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const Vec3 before = points_m[i == 0 ? 0 : i - 1], after = points_m[std::min(i + 1, points_m.size() - 1)];
    plant.knots.point_m.push_back(points_m[i]);
    plant.knots.handle_in_m.push_back(lerp(points_m[i], before, 1.0f / 3));
    plant.knots.handle_out_m.push_back(lerp(points_m[i], after, 1.0f / 3));
    plant.knots.radius_m.push_back(radii_m[i]);
  }
  plant.stems.first_knot.push_back(static_cast<std::uint32_t>(plant.knots.size()));
  plant.stems.parent.push_back(level == 0 ? -1 : 0);
  plant.stems.level.push_back(static_cast<std::uint8_t>(level));
  plant.stems.path_key.push_back(plant.stems.size());
  plant.stems.origin.push_back(-1);
  plant.stems.child_index.push_back(0);
}

inline void add_cylinder(Plant& plant, Vec3 from_m, Vec3 to_m, float radius_m) {
  const Vec3 points[] = {from_m, to_m};
  const float radii[] = {radius_m, radius_m};
  add_stem(plant, points, radii);
}

inline void add_leaf(Plant& plant, Vec3 position_m, Vec3 axis, Vec3 side, float length_m, float width_m,
                     LeafKind kind = LeafKind::leaf) {
  plant.leaves.position_m.push_back(position_m);
  plant.leaves.axis.push_back(axis);
  plant.leaves.side.push_back(side);
  plant.leaves.length_m.push_back(length_m);
  plant.leaves.width_m.push_back(width_m);
  plant.leaves.kind.push_back(kind);
}

/// A unit vector, uniform on the sphere.
inline Vec3 random_direction(RandomKey key, std::uint32_t index) {
  const float z = uniform_signed(key, 1, index);
  const float angle = std::numbers::pi_v<float> * uniform_signed(key, 2, index);
  const float r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// A tree-like plant of a given size: a trunk 10 m high, a crown of short bent stems with leaves around.
inline Plant random_tree(int stems, int leaves, Seed seed, float leaf_m = 0.17f) {
  Plant plant;
  const RandomKey key = root_key(seed);
  add_cylinder(plant, {0, 0, 0}, {0, 0, 10}, 0.15f);
  for (int i = 0; i < stems; ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    const float height = 3 + 7 * uniform_unit(key, 3, index);
    const Vec3 start = Vec3{0, 0, height} + random_direction(key, 4 * index) * (0.3f * (11 - height));
    const Vec3 heading = random_direction(key, 4 * index + 1) * 0.3f;
    const Vec3 bend = random_direction(key, 4 * index + 2) * 0.1f;
    const Vec3 points[] = {start, start + heading, start + heading * 2.0f + bend,
                           start + heading * 3.0f + bend * 2.0f};
    const float radii[] = {0.01f, 0.007f, 0.004f, 0.001f};
    add_stem(plant, points, radii, 1);
  }
  for (int i = 0; i < leaves; ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    const std::size_t knots = plant.knots.size();
    const Vec3 at = plant.knots.point_m[2 + random_bits(key, 5, index) % (knots - 2)];
    const Vec3 axis = random_direction(key, 0x40000000u + 2 * index);
    const Vec3 side =
        normalized(cross(axis, random_direction(key, 0x40000001u + 2 * index)), any_perpendicular(axis));
    add_leaf(plant, at + axis * (0.2f * uniform_unit(key, 6, index)), axis, side, leaf_m, leaf_m);
  }
  plant.leaf_shape = 3;
  plant.tree_scale_m = 10;
  return plant;
}

}  // namespace espalier
