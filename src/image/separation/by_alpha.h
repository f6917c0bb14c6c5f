// The tree by alpha, where alpha outlines a tree. It may as well outline a card, an oval or a drop shadow.
#pragma once
#include <espalier/image/separation/color_field.h>
#include <espalier/image/separation/separation.h>

namespace espalier {

/// What a picture's alpha says.
struct AlphaReading {
  bool informs = false;        ///< hides a part of the picture and shows another
  bool is_nothing = false;     ///< transparent everywhere
  bool outlines_card = false;  ///< what it shows is a convex sheet with a ground of its own: `shown`
  float shadow = 0;            ///< alpha of a drop shadow, 0: there is none
  float most = 1;              ///< the largest alpha
  Mask shown;                  ///< of a card: where it is opaque
};

AlphaReading read_alpha(const DecodedPicture& picture);

Separation separate_by_alpha(const DecodedPicture& picture, const AlphaReading& reading,
                             const SeparationOptions& options);

}  // namespace espalier
