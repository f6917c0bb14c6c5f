// What may be wrong with a picture of a tree, told from its mask in the picture's own size and place: the
// frame cuts the tree off, or there are several trees.
#pragma once
#include <string>
#include <vector>

#include <espalier/image/masks/mask.h>

namespace espalier {

struct PictureFaults {
  bool cut_left = false, cut_right = false, cut_top = false;
  bool cut_below = false;  ///< more than a trunk runs into the lower edge
  int trees = 1;           ///< apart from each other, side by side, standing equally low
  int rows = 1;            ///< of trees, one below the other, as on a sheet of sprites

  bool any() const { return cut_left || cut_right || cut_top || cut_below || trees > 1; }
};

/// A tree that only touches an edge is not cut there: what is cut is about as wide on the edge as a little
/// inside of it.
PictureFaults picture_faults(const Mask& mask);

/// The mask without the trees beside the largest; it is the same mask where there is one tree.
Mask largest_tree(const Mask& mask);

/// The trees as one reads, each alone; one where there are no several.
std::vector<Mask> trees_as_read(const Mask& mask);

/// A line for each fault; `took_largest`: of several trees, the largest was taken and not all of them.
std::vector<std::string> describe(const PictureFaults& faults, bool took_largest);

}  // namespace espalier
