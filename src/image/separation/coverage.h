// How much of each pixel the tree covers: the pixel as a mixture of the ground's colour and the tree's.
// Porter, Duff, Compositing digital images, SIGGRAPH 1984. The tree's colour is that of its plateaus, pixels
// whose neighbours have the same; beside a plateau of another colour, such as a trunk, it is that one's.
// Of trees of many colours what lies within counts whole, the fainter the farther it is from all ground.
#pragma once
#include <espalier/image/separation/color_field.h>
#include <espalier/image/separation/ground.h>

namespace espalier {

struct Coverage {
  Channel share;             ///< of each pixel: 0 for ground, 1 where nothing of it shines through
  bool is_soft = false;      ///< the picture is a mask or a probability, from black to white
  bool is_textured = false;  ///< the tree has many colours that are no mixtures of ground and tree
};

/// All zero where nothing stands out. `tree_color` where the caller knows it.
Coverage coverage_of(const DecodedPicture& picture, const Ground& ground,
                     const std::optional<ColorValue>& tree_color = {});

}  // namespace espalier
