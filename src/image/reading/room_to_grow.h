// Where a tree that is trained into an outline may be: inside of it, and beside its thin parts too. A twig as
// wide as a pixel leaves no way for a branch that must stay inside of it: each would be cut off at its foot.
#pragma once
#include <espalier/image/masks/mask.h>

namespace espalier {

/// The outline (outline_of), and what is within 1/64 of the picture's size of its parts that are narrower
/// than 1/32 of it. Of a tree that stands on roots also its trunk, straight down between them.
Mask room_to_grow(const Mask& outline, const Mask& tree);

}  // namespace espalier
