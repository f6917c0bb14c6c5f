// Plants that nobody chose: to begin a search far from any species.
#pragma once
#include <vector>

#include <espalier/fitting/starts/start_points.h>

namespace espalier {

/// `draws` plants, "random 1" and on, whose every parameter is uniform in the coordinates of a search (of its
/// range in `choice`, or in the table); what is fixed is kept. Each is prepared as starts are: it grows
/// within the budget, as tall as the target but for a tenth. The same seed draws the same plants. Throws
/// FieldError ("start") where a hundred draws in turn do not.
std::vector<StartPoint> random_starts(const Model& model, int draws, const SearchChoice& choice,
                                      const GrowthBudget& budget, double height_m, Seed plant_seed);

}  // namespace espalier
