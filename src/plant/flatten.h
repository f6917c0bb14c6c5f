// Stems as polylines: each cubic Bézier segment is cut into equal steps of its parameter, as few as keep
// the chords within a tolerance (metres) of the curve. The same stem and tolerance give the same points.
// Radii go linearly in the parameter between knots, as in all renderers of stems.
// Source: Wang's bound on the distance of a Bézier curve to its chords (Goldman, Pyramid Algorithms, 2003,
// §5.6).
#pragma once
#include <cstddef>
#include <vector>

#include <espalier/core/vec3.h>
#include <espalier/plant/plant.h>

namespace espalier {

struct Polyline {
  std::vector<Vec3> point_m;  ///< no two neighbours closer than a micrometre
  std::vector<float> radius_m;
  std::vector<PartColor> color;  ///< of the way to each point from the one before; empty: none is set

  std::size_t size() const { return radius_m.size(); }
};

/// Flattens stem `stem` of `plant` into `polyline`, whose memory is reused; from its base to its tip.
/// A stem without length gives a single point, one without knots none.
void flatten_stem(const Plant& plant, std::size_t stem, float tolerance_m, Polyline& polyline);

}  // namespace espalier
