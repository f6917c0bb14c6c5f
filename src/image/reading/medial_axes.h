// The axes of a tree-shaped mask: its trunk line, the lines of the branches on it, and so on. The mask is cut
// into bands of equal distance from the foot, along paths inside of it; the connected pieces of a band lie
// across one branch each, and their middles, joined from band to band, are the axes [Verroust & Lazarus 2000,
// Extracting skeletal curves from 3D scattered data]. Thin and crooked branches keep theirs, where erosion
// would lose them.
#pragma once
#include <limits>
#include <vector>

#include <espalier/image/masks/mask.h>

namespace espalier {

/// A place in pixels, as cameras count them: the centre of pixel (i, j) is (i + 0.5, j + 0.5).
struct PixelPoint {
  float x = 0, y = 0;
};

struct MedialAxis {
  int parent = -1;                 ///< index of the axis it leaves; -1: the trunk
  float start = 0;                 ///< where along the parent it leaves, as a share of the parent's length
  std::vector<PixelPoint> points;  ///< from its base to its tip, at least two
  std::vector<float> widths_px;    ///< across the mask at each of the points
  int runs_along = -1;             ///< the axis whose first points it has too; -1: none
  std::size_t shared_points = 0;   ///< how many these are; the next one is still on that axis
  float length_px = 0;             ///< along the points
  float width_px = 0;              ///< median of its lower third, which crossings do not change
};

/// The trunk first, parents before their children. The foot is the
/// lowest set row. Axes shorter than `shortest_px` are left out, and gaps of a pixel or two bridged; pieces
/// of the mask that no path joins to the foot have no axes. At most `levels` axes bear each other, trunk
/// included: they are so arranged that this leaves out none where it can, and what is a level too deep runs
/// along the axis that it leaves. Empty for an empty mask.
std::vector<MedialAxis> medial_axes(const Mask& mask, float shortest_px,
                                    int levels = std::numeric_limits<int>::max());

/// `count` points evenly spaced along a line of at least one, from its first to its last.
std::vector<PixelPoint> evenly_spaced(const std::vector<PixelPoint>& line, std::size_t count);

}  // namespace espalier
