// A grown plant: stems and leaves as plain arrays, reused from one plant to the next.
// Metres, z up, base of the first trunk near the origin. A stem is a cubic Bézier spline with a
// radius at each knot; how finely it is flattened is chosen by whoever draws or meshes it.
#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <espalier/core/vec3.h>

namespace espalier {

/// A colour that a model gives to a part: sRGB. Where it is not set, the part has that of its material.
struct PartColor {
  std::uint8_t r = 0, g = 0, b = 0;
  bool is_set = false;
  auto operator<=>(const PartColor&) const = default;  // NOLINT(modernize-use-nullptr): of its own 0
};

enum class LeafKind : std::uint8_t { leaf, blossom };

struct Stems {
  std::vector<std::uint32_t>
      first_knot;  ///< stems + 1 entries: stem s owns knots [first_knot[s], first_knot[s+1])
  std::vector<std::int32_t>
      parent;  ///< index of the parent stem, -1 for a trunk; a clone has its original's parent
  std::vector<std::uint8_t> level;      ///< 0 for trunks
  std::vector<std::uint64_t> path_key;  ///< the key of its random numbers: the same stem in another plant
  std::vector<std::int32_t>
      origin;  ///< index of the stem it sprang from: the parent, for a clone its original; -1: a trunk
  std::vector<std::uint32_t> child_index;  ///< which child of its origin: a part of its path (branch_path.h)

  std::size_t size() const { return level.size(); }
};

struct Knots {
  std::vector<Vec3> point_m, handle_in_m, handle_out_m;  ///< absolute positions
  std::vector<float> radius_m;
  std::vector<PartColor> color;  ///< of the segment that begins at the knot; empty: none is set

  std::size_t size() const { return radius_m.size(); }
};

/// A leaf is its kind's outline (plant/leaf_outlines.h) at unit size, scaled and placed:
/// world = position + side·(x·width) + axis·(y·length) + normal·(z·length), normal = side × axis.
struct Leaves {
  std::vector<Vec3> position_m;          ///< where the stalk is fixed to the stem
  std::vector<Vec3> axis, side;          ///< unit vectors: along the leaf, across it
  std::vector<float> length_m, width_m;  ///< scale of the unit outline along axis and side
  std::vector<LeafKind> kind;
  std::vector<PartColor> color;  ///< empty: none is set
  std::vector<std::uint32_t>
      shade;  ///< leaves of one number have the same shade of their material; empty: each has its own

  std::size_t size() const { return length_m.size(); }
};

/// In Leaves::shade: the colour of the material as it is.
inline constexpr std::uint32_t kPlainShade = ~std::uint32_t{0};

struct Plant {
  Stems stems;
  Knots knots;
  Leaves leaves;
  int leaf_shape = 8;      ///< 1..10, see leaf_outlines.h (0 is drawn as 8, elliptic)
  int blossom_shape = 1;   ///< 1..3
  float tree_scale_m = 0;  ///< nominal height drawn for the first trunk

  void clear();  ///< empties all arrays, keeps their memory
};

/// Memory that a plant keeps for the next one, in bytes.
std::size_t memory_bytes(const Plant& plant);

struct Bounds {
  Vec3 lower, upper;
};

/// The box around all stem surfaces and leaf polygons, in metres; zero-sized at the origin for an empty
/// plant.
Bounds bounds(const Plant& plant);

}  // namespace espalier
