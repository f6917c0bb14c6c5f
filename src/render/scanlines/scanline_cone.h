// One cone of a stem by scan lines. Pixels.
#pragma once
#include <espalier/image/masks/mask.h>

namespace espalier {

constexpr float kThinnestEllipsePx = 0.25f;  ///< half width up to which the end of a cone is a line

/// A disc across a stem: where its centre falls, and its radius.
struct ConeEnd {
  float x = 0, y = 0, radius = 0;
};

/// Sets the pixels whose centres lie on the silhouette of the cone between `a` and `b`, whose ends are flat.
/// tilt: |cosine| of the angle between the cone's axis and the view, 0 where it lies across the view.
void draw_cone(ConeEnd a, ConeEnd b, float tilt, Mask& mask);

/// The two ends alone: discs that are seen as ellipses, where they are wide enough to show.
void draw_cone_ends(ConeEnd a, ConeEnd b, float tilt, Mask& mask);

}  // namespace espalier
