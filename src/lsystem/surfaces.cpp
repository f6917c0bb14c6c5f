#include "lsystem/surfaces.h"

namespace espalier::lsystem {

int surface_by_name(std::string_view name, const Position& position) {
  if (name == "leaf") return static_cast<int>(Surface::leaf);
  if (name == "blossom") return static_cast<int>(Surface::blossom);
  throw_at(position, "got surface '{}', expected \"leaf\" or \"blossom\"", name);
}

}  // namespace espalier::lsystem
