// How a silhouette fills its rows from the middle to the ends, and how rough and lopsided the rows' ends are:
// layers of branches, drooping tips and the bends of a trunk show there.
#pragma once
#include <string>
#include <vector>

#include <espalier/image/masks/mask.h>
#include <espalier/image/masks/mask_box.h>

namespace espalier {

/// Appends, of each tier: cover of four rings from the middle of the rows to their ends, steps of both ends
/// from row to row, how far the rows' middles lie from the foot; and how much rows differ in width within
/// each of 16 heights. Lengths are shares of the tree's height, but for steps, which are pixels.
void add_crown_outline(const Mask& mask, const MaskBox& box, std::vector<double>& summaries);
void name_crown_outline(std::vector<std::string>& names);

}  // namespace espalier
