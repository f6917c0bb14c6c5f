// Leaves and wood told apart by their colours. The trunk below the crown shows what wood looks like; what is
// unlike it in the crown is leaves, whatever their colour. Where no trunk is seen, or it looks like the
// crown, what is green is leaves. What is neither for sure is in doubt, and so is everything where the
// colours do not say: then the kind of tree says what to expect.
#pragma once
#include <string>

#include <espalier/image/masks/mask.h>
#include <espalier/image/pictures/decode.h>

namespace espalier {

struct PlantLabels {
  Mask leaf, wood;                        ///< of one size; empty where the colours do not say
  int px_per_label = 1;                   ///< side of the blocks of the picture's pixels that share a label
  double leaf_share = 0, wood_share = 0;  ///< of the tree's pixels; the rest is in doubt
  std::string how;  ///< one line: "leaves and wood by colour: 71 % leaf, 9 % wood, 20 % in doubt"

  bool are_known() const { return leaf_share + wood_share > 0; }
};

/// `tree`: the pixels of the picture, of its size, that show the tree; at least one.
PlantLabels label_plant(const DecodedPicture& picture, const Mask& tree);

}  // namespace espalier
