// The tree of a picture, told from its ground, and how that was done.
#pragma once
#include <string>
#include <vector>

#include <espalier/image/masks/mask.h>

namespace espalier {

struct Separation {
  Mask mask;
  std::string how;  ///< "alpha above 0.5", "luminance below 0.41 (Otsu), the border is light"
  std::vector<std::string> left_out;  ///< of the picture, a line each
  std::vector<std::string> warnings;  ///< what of it may be wrong, a line each
  double confidence = 1;              ///< share of what stands out that is clearly tree or clearly ground
};

}  // namespace espalier
