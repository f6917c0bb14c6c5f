// Overrides as a tree that people read: a line a node, indented by its depth, with what it says itself, what
// it inherits, and whether its branch grows.
#pragma once
#include <functional>
#include <string>

#include <espalier/overrides/overrides.h>

namespace espalier {

/// `grows` tells whether the branch of a path is there; others are called dormant. Lines begin with `prefix`.
std::string overrides_tree(const Overrides& overrides, const std::function<bool(const BranchPath&)>& grows,
                           const std::string& prefix);

}  // namespace espalier
