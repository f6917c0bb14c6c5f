// The kinds of geometry in a plant's Embree scene, as arrays that Embree reads in place: cones or round
// Bézier curves for stems, flat polygons for leaves (user geometry: a triangulated leaf would be five to
// twelve primitives), triangles for blossoms and for what stands beside the plant. Metres.
// Segments and leaves without a finite, positive size are left out. Each struct is filled anew by
// collect(), keeps its memory, and must outlive the commit and the rays of the geometry it is set on.
#pragma once
#include <embree3/rtcore.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <espalier/plant/leaf_half.h>
#include <espalier/plant/plant.h>
#include <espalier/render/scene_objects.h>

namespace espalier {

/// How a segment of a stem becomes primitives. Both have flat ends and a radius linear along the segment.
enum class StemSurface {
  cones,   ///< capped cones along a polyline close to the curve: traces 8 times as fast
  curves,  ///< Embree's swept surface: the exact one, open at its ends
};

struct StemSegments {
  struct ControlPoint {
    float x, y, z, radius;
  };

  /// Cones stay within `tolerance_m` of the curve, and gaps between them at its joints below it.
  void collect(const Plant& plant, StemSurface surface, float tolerance_m);
  void set_on(RTCGeometry geometry) const;
  std::size_t size() const { return first_control_point.size(); }

  std::vector<ControlPoint> control_points;
  std::vector<std::uint32_t> first_control_point;  ///< of each primitive
  std::vector<std::uint8_t> neighbours;            ///< RTCCurveFlags of each cone
  std::vector<std::uint32_t> knot;  ///< of each primitive: index in Plant::knots where its segment begins
};

/// One plane a leaf, with the outline that all share.
struct LeafPolygons {
  /// x and y of the outline at a point p of the plane are the products of p − position with the two vectors.
  struct Plane {
    Vec3 position_m, normal, x_per_m, y_per_m;
  };
  void collect(const Plant& plant);
  void set_on(RTCGeometry geometry);
  std::size_t size() const { return planes.size(); }

  std::vector<Plane> planes;
  std::vector<Bounds> boxes;
  std::vector<std::uint32_t> leaf;  ///< index in Plant::leaves of each plane
  const LeafHalf* half = nullptr;   ///< of the outline
};

struct Triangles {
  void set_on(RTCGeometry geometry) const;
  std::size_t size() const { return triangles.size(); }

  std::vector<std::array<float, 4>> vertices;  ///< the fourth number pads to 16 bytes
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct BlossomTriangles : Triangles {
  void collect(const Plant& plant);

  std::vector<std::uint32_t> leaf;  ///< index in Plant::leaves of each triangle
};

struct ObjectTriangles : Triangles {
  void collect(const SceneObjects& objects);
};

}  // namespace espalier
