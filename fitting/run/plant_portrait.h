// What a fitted plant looks like as a plant, which no measure of its silhouette says: how much of its wood
// shows, how deep it is, how many leaves it has; and a sheet with its picture from three sides beside the
// target.
#pragma once
#include <espalier/fitting/task/fit_task.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/overrides/overrides.h>
#include <espalier/plant/plant.h>

namespace espalier {

struct PlantPortrait {
  double visible_wood =
      0;                  ///< share of the plant's pixels that show wood, from where the first picture looks
  double crown_wood = 0;  ///< the same without trunks, which many pictures show
  double depth_over_width = 0;  ///< of the plant's box, along that direction and across it; 0 without a width
  double stems = 0, leaves = 0;  ///< how many
  double override_numbers = 0;   ///< of the branches: what the tree needs beyond its parameters
};

/// What summaries and the tables of experiments say of a plant.
struct PlantMeasure {
  const char* name;
  double PlantPortrait::*value;
  bool counts = false;
};

inline constexpr PlantMeasure kPlantMeasures[] = {
    {"visible_wood", &PlantPortrait::visible_wood},
    {"crown_wood", &PlantPortrait::crown_wood},
    {"depth_over_width", &PlantPortrait::depth_over_width},
    {"stems", &PlantPortrait::stems, true},
    {"leaves", &PlantPortrait::leaves, true},
    {"override_numbers", &PlantPortrait::override_numbers, true},
};

PlantPortrait portray(const Plant& plant, const View& front, const Overrides& overrides);

/// Target, and the plant shaded from the front, from the side and from in between, at one scale: four tiles.
Picture plant_sheet(const Plant& plant, const TargetView& target, const View& front);

}  // namespace espalier
