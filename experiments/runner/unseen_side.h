// How a fit does on the side of a known tree that its picture does not show: the fitted plant from there
// against the tree itself, and beside it siblings, trees of the tree's own parameters with other seeds. A fit
// that learnt nothing of the other side than the species does as well as they do.
#pragma once
#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/run/fit.h>

namespace espalier {

/// A tree whose parameters are known: of a bundled species or a preset file.
struct KnownTree {
  std::string species;
  Seed seed = 1;
};

struct SideScores {
  double front_iou = 0, side_iou = 0;                  ///< of the fitted plant
  double sibling_front_iou = 0, sibling_side_iou = 0;  ///< means over the siblings
};

/// Columns of the results.
struct SideColumn {
  const char* name;
  double SideScores::*value;
};

inline constexpr SideColumn kSideColumns[] = {
    {"front_iou", &SideScores::front_iou},
    {"side_iou", &SideScores::side_iou},
    {"sibling_front_iou", &SideScores::sibling_front_iou},
    {"sibling_side_iou", &SideScores::sibling_side_iou},
};

/// From where the record's first picture looks, and a quarter turn around the tree from there. Throws
/// InputError where the tree is beyond the growth budget.
SideScores score_sides(const FitRecord& record, const FitResult& result, const KnownTree& tree, int siblings);

}  // namespace espalier
