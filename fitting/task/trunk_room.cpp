#include <espalier/fitting/task/trunk_room.h>

namespace espalier {

bool leaves_room_for_trunk(const Volume& volume, double height_m) {
  constexpr int kSteps = 8;
  const auto step_m = static_cast<float>(height_m / 16 / kSteps);
  for (int level = 2; level <= kSteps; ++level) {  // the first may lie below the foot's pixels
    bool has_room = false;
    for (int aside = -level; aside <= level && !has_room; ++aside)
      has_room = volume.contains({static_cast<float>(aside) * step_m, 0, static_cast<float>(level) * step_m});
    if (!has_room) return false;
  }
  return true;
}

}  // namespace espalier
