// Leaves kept inside of a volume: what training and pruning to a picture's outline do after stems have grown.
#pragma once
#include <espalier/environment/volume.h>
#include <espalier/plant/plant.h>

namespace espalier {

/// Makes leaves of which less than three quarters are inside of the volume smaller, by no more than half;
/// those that still reach out are taken away. The order of those that stay is kept.
void keep_leaves_inside(const Volume& volume, Leaves& leaves);

}  // namespace espalier
