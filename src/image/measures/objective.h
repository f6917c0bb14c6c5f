// Weighted sums of measures for a search to minimise, and their text: "0.5*truncated_distance+0.5*iou".
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <espalier/image/masks/mask.h>
#include <espalier/image/measures/prepared_target.h>

namespace espalier {

struct ObjectiveTerm {
  std::string name;  ///< one of objective_names()
  double weight = 1;
};

/// A weighted sum of dissimilarities; the weights sum to 1.
struct MaskObjective {
  std::vector<ObjectiveTerm> terms;
};

/// What a term can be: the measures that an objective may be made of, by all of their names.
std::vector<std::string> objective_names();

/// Reads "iou", or a sum of weighted terms: "0.5*truncated_distance+0.5*iou". Weights are scaled to
/// sum 1. Throws InputError for unknown names and for weights that are not positive and finite.
MaskObjective parse_objective(std::string_view text);

/// The text that parse_objective reads back.
std::string to_string(const MaskObjective& objective);

/// In [0, 1], 0 is best. Each measure enters as its dissimilarity_of.
double dissimilarity(const MaskObjective& objective, const Mask& candidate, const PreparedTarget& target);
double dissimilarity(const MaskObjective& objective, const Mask& candidate, const Mask& target);

}  // namespace espalier
