// What the border of a picture shows: its colours all the way round, without what only touches it.
#pragma once
#include <vector>

#include <espalier/image/masks/mask.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/image/separation/separation_options.h>

namespace espalier {

/// A place of the border, and what the ground is like there: the median of a tenth of the border around it.
struct BorderPlace {
  int x = 0, y = 0;
  ColorValue ground{};
  float noise = 0;  ///< median distance of that part of the border from its ground

  /// How far a pixel of the ground may be from it.
  float tolerance() const;
};

struct BorderColors {
  std::vector<BorderPlace> places;  ///< all pixels of the outermost rings of what is shown
  ColorValue color{};               ///< median of all
  float noise = 0;                  ///< 90 % of the places of about that colour are nearer to it than this
  double share = 0;                 ///< of the places, those near that colour
};

/// `shown`: the part of the picture that counts. A border that mostly has one colour has it everywhere.
BorderColors border_colors(const DecodedPicture& picture, const Mask& shown);

}  // namespace espalier
