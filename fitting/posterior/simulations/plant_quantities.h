// What a forester measures of a tree, derived from a grown plant: crown and wood volumes, leaf area, counts,
// crown base, trunk radius at breast height.
#pragma once
#include <array>
#include <span>
#include <vector>

#include <espalier/plant/plant.h>

namespace espalier {

struct PlantQuantity {
  const char* name;
  const char* unit;
  int metres;  ///< power of the metre in its unit: how it grows with the tree
  const char* help;
};

inline constexpr std::array<PlantQuantity, 7> kPlantQuantities{{
    {"crown_volume", "m3", 3, "of the layers of the crown, each the star-shaped outline around its middle"},
    {"leaf_area", "m2", 2, "one side of all leaves and blossoms"},
    {"wood_volume", "m3", 3, "of all stems, as frustums between their knots"},
    {"leaves", "1", 0, "leaves and blossoms"},
    {"stems", "1", 0, "stems of all levels, the trunk among them"},
    {"crown_base", "m", 1, "height below which a fiftieth of the leaves lies, or of a bare tree's branches"},
    {"trunk_radius", "m", 1, "of the first trunk at 1.3 m, or at half the height of a tree under 2.6 m"},
}};

/// Of `plant`, in the order of kPlantQuantities, as if it were scaled to `height_m`. `lowest_m` and `tall_m`
/// are where the plant ends below, and how tall it is before, in its own metres; tall_m > 0.
std::vector<double> quantities_of(const Plant& plant, double lowest_m, double tall_m, double height_m);

}  // namespace espalier
