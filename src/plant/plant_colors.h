// Colours of a species: of its bark, of its leaves, and of its leaves in autumn. sRGB; what is not set has
// the usual colour of its material.
#pragma once
#include <optional>
#include <string>

#include <espalier/plant/plant.h>

namespace espalier {

struct PlantColors {
  PartColor bark, leaf, autumn;

  bool operator==(const PlantColors&) const = default;
};

/// "#ece9e2" as a colour; nothing for other texts.
std::optional<PartColor> parse_color(const std::string& text);

/// "#ece9e2".
std::string color_text(PartColor color);

}  // namespace espalier
