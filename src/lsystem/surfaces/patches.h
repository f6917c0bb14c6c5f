// Bicubic surfaces as text: each word "patch" opens one, and the 48 numbers after it are its 4 × 4 control
// points x y z, row by row, in the frame of a leaf (lsystem/surfaces/appearance.h). A # starts a comment.
// Source: Bézier patches, [ABOP §5.1].
#pragma once
#include <string>
#include <vector>

#include <espalier/lsystem/surfaces/polygon.h>

namespace espalier::lsystem {

/// A patch is cut into this many steps a side, each of two triangles.
inline constexpr int kPatchSteps = 6;

/// The patches of a text as triangles. Throws InputError with file and line for anything else, more than 100
/// patches, or numbers beyond ±10⁶.
std::vector<Triangle> read_patches(const std::string& text, const std::string& label);

}  // namespace espalier::lsystem
