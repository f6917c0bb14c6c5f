// Stage 1 of a fit (docs/branches.md): what a mask says of its tree before anything is grown. All measures
// but one are relative to the tree's height, so that they hold at any resolution.
#pragma once
#include <espalier/fitting/picture/tree_kind.h>
#include <espalier/image/masks/mask.h>
#include <espalier/image/reading/plant_labels.h>

namespace espalier {

struct PictureReading {
  TreeKind kind = TreeKind::leafy;
  int height_px = 0;
  double trunk_width = 0;      ///< a little above the foot, or above what the trunk stands on
  double foot_width = 0;       ///< of the lowest row: where the trunk flares
  double stand_height = 0;     ///< of a mound or a pot under the trunk; 0 for the ground
  double crown_base = 0;       ///< height at which the outline becomes wider than a trunk
  double crown_width = 0;      ///< of the whole tree
  double cover = 0;            ///< set share of the filled outline: 1 - porosity
  double hull_cover = 0;       ///< set share of the convex hull
  double clump_width = 0;      ///< mean width of what is set, once the narrowest gaps are closed
  int trunks = 1;              ///< separate stems at the foot
  bool touches_frame = false;  ///< at the sides or the top: the picture cuts the tree off
};

/// Throws InputError for an empty mask.
PictureReading read_picture(const Mask& mask);

/// The kind that a picture shows, of which its colours know more than its outline: what has leaves is not
/// leafless, however open its crown is.
TreeKind kind_with_labels(TreeKind of_outline, const PlantLabels& labels);

}  // namespace espalier
