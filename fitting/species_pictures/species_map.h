// The map of a species space: a small tree at each species' point, axes with the variance they explain, and
// beside it the parameters that move a point most, as arrows.
#pragma once
#include <espalier/charts/chart_layout.h>
#include <espalier/fitting/species_space/species_space.h>

namespace espalier {

struct SpeciesMap {
  ChartLayout layout;
  int width_px = 0, height_px = 0;
};

/// Maps the first two components; a space of one dimension is a line. Trees that would lie over each other
/// are moved apart, each with a line to its point.
SpeciesMap draw_species_map(const SpeciesSpace& space);

}  // namespace espalier
