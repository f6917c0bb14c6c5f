// The crown shapes: how long a first-level branch is at a given height [Weber & Penn 95, §4.4], and the
// pruning envelope, which is one of them. Ratios without unit.
#pragma once
#include <espalier/core/vec3.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier {

/// Length factor at `ratio` (0 at the crown's top, 1 at its base) for shape 0 conical … 8 envelope.
float shape_ratio(int shape, float ratio, const WeberPennParameters& parameters);

/// The same for the crown of `parameters`: its shape, with the share shape_mix of shape_2.
float crown_shape_ratio(float ratio, const WeberPennParameters& parameters);

/// True inside the pruning envelope [Weber & Penn 95, §4.6]: a solid of revolution about the z axis as
/// high as the tree. `point_m` relative to the tree's base.
bool inside_envelope(Vec3 point_m, float tree_scale_m, const WeberPennParameters& parameters);

/// True only where the whole ball is inside; cheaper than many points, and false near the envelope.
bool ball_inside_envelope(Vec3 center_m, float radius_m, float tree_scale_m,
                          const WeberPennParameters& parameters);

}  // namespace espalier
