// Strips along the edges of a picture that are no part of it: the frame of a print, the dark edge of a scan,
// the bars of a screen.
#pragma once
#include <string>

#include <espalier/image/masks/mask.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/image/separation/separation_options.h>

namespace espalier {

/// How many pixels of each edge such strips take.
struct BorderStrips {
  int left = 0, right = 0, top = 0, bottom = 0;

  bool any() const { return left + right + top + bottom > 0; }
};

/// A strip is of one colour along the whole edge and ends in a straight line.
BorderStrips find_border_strips(const DecodedPicture& picture);

/// "border strips: 20 px left, 12 px above".
std::string describe(const BorderStrips& strips);

}  // namespace espalier
