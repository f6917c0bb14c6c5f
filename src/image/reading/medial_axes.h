// The axes of a tree-shaped mask: its trunk line, the lines of the branches on it, and so on. The mask is cut
// into bands of equal distance from the foot, along paths inside of it; the connected pieces of a band lie
// across one branch each, and their middles, joined from band to band, are the axes [Verroust & Lazarus 2000,
// Extracting skeletal curves from 3D scattered data]. Thin and crooked branches keep theirs, where erosion
// would lose them.
#pragma once
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
  float length_px = 0;             ///< along the points
  float width_px = 0;              ///< median of its lower third, which crossings do not change
};

/// The trunk first, parents before their children, children of one axis from its base up. The foot is the
/// lowest set row. Axes shorter than `shortest_px` are left out, and gaps of a pixel or two bridged; pieces
/// of the mask that no path joins to the foot have no axes. Empty for an empty mask.
std::vector<MedialAxis> medial_axes(const Mask& mask, float shortest_px);

/// `count` points evenly spaced along a line of at least one, from its first to its last.
std::vector<PixelPoint> evenly_spaced(const std::vector<PixelPoint>& line, std::size_t count);

}  // namespace espalier
