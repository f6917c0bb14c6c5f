// The axis of a branch as it is drawn: a curve in space that the stem follows instead of what the model bends
// it by [Boudon et al. 2003, Interactive design of bonsai tree models, §2.1: a parameter that is a 3-D
// curve]. It says the stem's form; how long it is the length says. It is of that branch alone: no branch
// inherits it.
#pragma once
#include <cstdint>
#include <vector>

#include <espalier/core/curves/axis.h>

namespace espalier {

/// What the axis turns with.
enum class AxisFrame : std::uint8_t {
  parent,  ///< the branch as it stands on its parent: z along it, x to its right, y away from the parent
  world    ///< nothing: x to the right of the front view, y away from the viewer, z up
};
inline constexpr const char* kAxisFrames[] = {"parent", "world"};  ///< in their order

struct DrawnAxis {
  std::vector<AxisPoint> points;  ///< after the base, as many as make_axis() takes
  AxisFrame frame = AxisFrame::parent;
};

/// The same, ready for growing.
struct StemAxis {
  AxisCurve curve;
  AxisFrame frame = AxisFrame::parent;
};

}  // namespace espalier
