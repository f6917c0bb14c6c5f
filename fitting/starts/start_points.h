// Where a fit begins: presets, made as tall as the target and thinned to the growth budget.
// What their parameters are to a fit the model's table says by roles; a model without these is left as it is.
#pragma once
#include <string>
#include <vector>

#include <espalier/core/parameter_table.h>
#include <espalier/core/random.h>
#include <espalier/fitting/record/search_space.h>
#include <espalier/fitting/record/start_names.h>
#include <espalier/overrides/overrides.h>
#include <espalier/plant/model.h>

namespace espalier {

struct StartPoint {
  std::string name;  ///< "quaking_aspen", "quaking_aspen without leaves"
  ParameterValues values;
  Overrides overrides = {};    ///< of a preset as it is written
  bool has_own_crown = false;  ///< of make_start_points(): one in use before values are fixed
};

/// Makes a candidate of any plant: its size does not vary, counts may be relaxed, it is thinned until this
/// seed's tree grows within the budget, and that tree is `height_m` tall.
void prepare_start(const Model& model, const GrowthBudget& budget, double height_m, Seed plant_seed,
                   ParameterValues& values);

/// Whether there are leaves, and a count of them that may be 0; without one there are none to take.
bool has_leaves(const ParameterTable& table, const ParameterValues& values);
void take_leaves(const ParameterTable& table, ParameterValues& values);

/// The presets of `start` as they are written: with their overrides, not scaled and not thinned. Of random
/// plants there are none. Throws InputError as make_start_points does.
std::vector<StartPoint> presets_as_written(const ParameterTable& table, const StartNames& start);

/// The start points of `start` [start_names.h]. Each preset also without its leaves, if it has any. Grown
/// trees are `height_m` tall. Fixed values are set, counts may be relaxed, and the size does not vary from
/// tree to tree. Throws InputError for presets that cannot be read or are of another model.
std::vector<StartPoint> make_start_points(const Model& model, const StartNames& start,
                                          const SearchChoice& choice, const GrowthBudget& budget,
                                          double height_m, Seed plant_seed);

}  // namespace espalier
