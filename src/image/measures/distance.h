// Truncated distances between masks, by repeated dilation of whole words.
// The octagonal distance d(p, m): the number of dilations, by a plus and a 3×3 square in turn, after
// which m holds p (Rosenfeld, Pfaltz 1968, Distance functions on digital pictures). In pixels.
#pragma once
#include <cstddef>
#include <vector>

#include <espalier/image/masks/mask.h>

namespace espalier {

/// Sum of min(d(p, from), limit_px) over the set pixels p of `over`. An empty `from` is limit_px away.
std::size_t sum_distances_px(const Mask& over, const Mask& from, int limit_px);

/// Bit planes of min(d(p, from), limit_px): plane j holds bit j of each pixel's value.
std::vector<Mask> distance_bit_planes(const Mask& from, int limit_px);

/// The same sum as sum_distances_px, from the planes.
std::size_t sum_distances_px(const Mask& over, const std::vector<Mask>& bit_planes);

}  // namespace espalier
