// The asymmetric crown envelope (environment/crown_envelope.h) that a picture shows: its top, its base, the
// rim on both sides, and how it bulges. All relative to the tree's height, from its foot, x to the right.
#pragma once
#include <string>

#include <espalier/environment/crown_envelope.h>
#include <espalier/fitting/picture/picture_reading.h>

namespace espalier {

struct CrownReading {
  double top = 1, top_x = 0, base = 0, base_x = 0;
  double radius_right = 0, radius_left = 0;  ///< of the rim, at least a pixel
  double rim_right = 0, rim_left = 0;        ///< its height there
  double shape_above = 2, shape_below = 2;   ///< by least squares, 0.3 … 10
};

/// Of a mask of `reading`. The crown is what lies above where it begins, its gaps closed; a side's rim is
/// where it is widest. Throws InputError for a mask without a crown: of less than three rows.
CrownReading read_crown(const Mask& mask, const PictureReading& reading);

/// That of a tree `height_m` tall. Its front and back, which are not seen, are as the mean of its sides.
CrownShape crown_shape_of(const CrownReading& crown, double height_m);

/// The same as text: "crown(top = 12, bottom = 3, …)".
std::string crown_text(const CrownReading& crown, double height_m);

}  // namespace espalier
