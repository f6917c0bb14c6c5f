// What a file says of how its strings look, besides its settings: the table of colours, and the surfaces that
// it names: also whole plants, of which copies are placed. Colours are sRGB; surfaces are triangles in the
// frame of a leaf: x to its right, y along it, z up from it, in units, the origin where it is fixed.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <espalier/lsystem/strings/source.h>
#include <espalier/lsystem/surfaces/polygon.h>
#include <espalier/plant/joints.h>

namespace espalier::lsystem {

struct NamedNumber {
  std::string name;
  double value = 0;
  Position position;
};

/// plant hedge = "hedge.lsys" length=8 seed=2: noted when the file is parsed, grown once it is read.
struct PlantDeclaration {
  std::string file;
  std::vector<NamedNumber> numbers;
  Position position;  ///< of the file's name
};

struct NamedSurface {
  std::string name;
  std::vector<Triangle> triangles;
  std::optional<PlantDeclaration> declared;   ///< instead of triangles: a plant
  std::shared_ptr<const JointedPlant> plant;  ///< the same, grown: in units, as its turtle drew it
};

struct Appearance {
  std::string file;               ///< what messages call the L-system
  std::vector<PartColor> colors;  ///< colour i is colors[i - 1]; 0 leaves a part the colour of its material
  std::vector<NamedSurface> surfaces;

  PartColor color(int index) const {
    return index > 0 ? colors[static_cast<std::size_t>(index) - 1] : PartColor{};
  }
};

/// Brown, green, yellow, red, white, pink, violet and blue, for files without a table.
std::vector<PartColor> default_colors();

}  // namespace espalier::lsystem
