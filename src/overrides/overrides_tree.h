// Overrides as a tree that people read: a line a node, indented by its depth, with what it says itself, what
// it inherits, and whether its branches grow. Nodes of ranges come first, in their order.
#pragma once
#include <string>
#include <vector>

#include <espalier/overrides/change_graph.h>

namespace espalier {

/// How many stems of a plant each node is of, given the place in the graph of each stem
/// (GrowthSettings::stem_cursors): of Overrides::nodes, then of Overrides::ranges.
std::vector<std::size_t> count_branches(const Overrides& overrides,
                                        const std::vector<ChangeCursor>& stem_cursors);

/// `branches`: as count_branches() counts them; nodes of none are called dormant. Lines begin with `prefix`.
std::string overrides_tree(const Overrides& overrides, const std::vector<std::size_t>& branches,
                           const std::string& prefix);

}  // namespace espalier
