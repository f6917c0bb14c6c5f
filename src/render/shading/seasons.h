// What a season makes of a plant in a shaded picture: which leaves are there, and their colour. Models know
// no seasons; blossoms are theirs (blossom_rate).
#pragma once
#include <string>
#include <vector>

#include <espalier/plant/plant_colors.h>
#include <espalier/render/shading/shaded.h>

namespace espalier {

/// Names of the seasons, the one as models grow plants first: summer, autumn, winter, spring.
std::vector<std::string> season_names();

/// Throws InputError, which names the seasons there are.
void check_season(const std::string& name);

/// Gives bark and leaves the colours of their species, where it has some: in autumn those of its leaves then.
/// After apply_season, whose colours are those of all species.
void apply_colors(const PlantColors& colors, const std::string& season, ShadedSettings& settings);

/// In winter the plant loses leaves and blossoms; in autumn and spring its leaves have other colours, unless
/// the model gave them one. Throws as check_season does.
void apply_season(const std::string& name, Plant& plant, ShadedSettings& settings);

}  // namespace espalier
