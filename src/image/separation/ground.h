// The ground behind a tree: grown from the border inwards over colours that change slowly, so that a sky, a
// dusk, dark corners and a lawn are each followed; what it surrounds is interpolated.
// Adams, Bischof, Seeded region growing, IEEE Trans. PAMI 16 (1994).
#pragma once
#include <optional>

#include <espalier/image/masks/mask.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/image/separation/border_colors.h>
#include <espalier/image/separation/color_field.h>

namespace espalier {

struct Ground {
  Mask reached;         ///< pixels that are ground for sure
  Mask claimed;         ///< pixels that are tree for sure, of the caller's seeds
  Channel contrast;     ///< distance of each pixel's colour from the ground's there; 0 where nothing is shown
  float tolerance = 0;  ///< contrast that the ground itself may have
  std::optional<ColorValue> color;   ///< where it is the same everywhere
  std::optional<SmoothField> field;  ///< where it varies
  double border_share = 0;           ///< of the border, what is like the ground beside it

  ColorValue color_at(int x, int y) const { return field ? field->at(x, y) : color.value_or(ColorValue{}); }
};

/// `shown`: the part of the picture that counts.
Ground find_ground(const DecodedPicture& picture, const Mask& shown, const BorderColors& border,
                   const SeparationOptions& options);

}  // namespace espalier
