// What one species allows of its parameters, beside how the species of a model differ. Lengths are compared
// as shares of the tree's size, so that a small tree of a species is still of that species.
#pragma once
#include <span>
#include <vector>

#include <espalier/core/parameter_table.h>
#include <espalier/fitting/record/search_space.h>

namespace espalier {

/// Standard deviation of each row over these species; 0 for choices.
std::vector<double> spread_of_species(const ParameterTable& table, std::span<const ParameterValues> species);

/// Whether the row says how large the tree is, and not what it is like.
bool is_tree_size(const ParameterInfo& row);

/// Half of the spread of species, in the units of this row of a species' own values.
double reach_of_species(const ParameterTable& table, std::size_t row, const ParameterValues& species,
                        std::span<const double> spread);

/// Half of the spread on both sides of the species' own values: closer to it than to most others. Choices,
/// and what all species share, are fixed; the tree's size is left free. Added to `choice`, whose fixed values
/// stay.
void keep_to_species(const ParameterTable& table, const ParameterValues& species,
                     std::span<const double> spread, SearchChoice& choice);

}  // namespace espalier
