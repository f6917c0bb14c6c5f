// What a silhouette says of its tree whatever random numbers the tree has: how wide and how full it is at
// each height, how it falls into gaps and pieces, how rough its outline is, what its trunk is like. Another
// tree of the same parameters has nearly the same numbers, where its pixels are others. Left and right count
// alike. Lengths are shares of the tree's height.
#pragma once
#include <string>
#include <vector>

#include <espalier/image/masks/mask.h>

namespace espalier {

/// Side of the frame that summaries are made for: radii of gaps and pieces are in its pixels.
inline constexpr int kSummaryFramePx = 128;

/// In the order of summaries_of: "width 03" (of 16 heights, from the top), "pieces within 2 px", …
const std::vector<std::string>& summary_names();

/// Of a mask that is framed (image/reading/frame.h) in kSummaryFramePx. Throws InputError for an empty one.
std::vector<double> summaries_of(const Mask& mask);

/// A tree's mask at any size becomes one that summaries can be made of, by the pixels at its pixels' centres:
/// thin twigs stay as they are, as in a silhouette drawn at that size. Throws InputError for an empty mask.
Mask framed_for_summaries(const Mask& mask);

}  // namespace espalier
