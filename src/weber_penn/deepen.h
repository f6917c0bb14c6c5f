// The same tree with more levels of branching: each leaf of the last level moves to a stalk of its own, so
// short that it does not show. A tree of two levels becomes one of three in small steps this way: the stalks
// grow into twigs (docs/species_space.md).
#pragma once
#include <span>

#include <espalier/core/parameter_table.h>

namespace espalier {

/// `values` of weber_penn_table() as a tree of `levels` levels, or as they are where it has as many or more.
/// Silhouettes are those of the tree but for details: leaves of one stalk are drawn together, and counts may
/// be relaxed.
ParameterValues deepened_values(std::span<const double> values, int levels);

}  // namespace espalier
