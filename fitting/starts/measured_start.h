// Stage 2 of a fit: starts made to the measure of the picture, and the ranges that keep the search at
// plausible plants: wood no thicker than the trunk that is seen, leaves no longer than leaves are, a crown
// that begins where the picture's does. Which parameters these are the model's table says by roles
// (core/parameter_role.h); a model without them is left as it is.
#pragma once
#include <map>
#include <string>

#include <espalier/fitting/picture/picture_reading.h>
#include <espalier/fitting/record/search_space.h>
#include <espalier/plant/model.h>

namespace espalier {

/// How large leaves of leafy trees may be: as those of the bundled species are, or larger ones, which fill
/// crowns as blobs.
enum class LeafSizes { of_species, any };

/// Ranges by full names of parameters of `table`, for a tree `height_m` tall. Parameters whose valid values
/// lie outside of them have none, nor have lengths in units of the model's own, which may change.
std::map<std::string, SearchRange> measured_ranges(const ParameterTable& table, const PictureReading& reading,
                                                   TreeKind kind, double height_m,
                                                   LeafSizes leaf_sizes = LeafSizes::of_species);

/// Gives a preset, which is `height_m` tall, the picture's trunk, height of the crown and width of the crown,
/// as far as the preset's form lets it.
void take_measures(const Model& model, const GrowthBudget& budget, const PictureReading& reading,
                   double height_m, Seed plant_seed, ParameterValues& values);

}  // namespace espalier
