// Growing a whole tree, level by level [CH §3.2].
#pragma once
#include <espalier/plant/model.h>
#include <espalier/weber_penn/table/branch_parameters.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier {

/// Whether vector instructions compute many stems and leaves at a time, or the plain formulas one by one: the
/// same plant within the rounding of floats.
enum class Lanes { many, one };

/// Grows into `plant`. Stops, and reports by how much, where stems or leaves exceed the budget.
/// `of_branches`: where some have parameters of their own by `settings.changes`; else null.
GrowthResult grow_tree(const WeberPennParameters& parameters, Seed seed, const GrowthSettings& settings,
                       Plant& plant, Lanes lanes = Lanes::many,
                       const BranchParameters* of_branches = nullptr);

}  // namespace espalier
