// Whether a volume made from a picture can hold the trunk of its tree. The base of the tree is the middle of
// what stands lowest in the picture: between two feet, or below hanging twigs, there is no room.
#pragma once
#include <espalier/environment/volume.h>

namespace espalier {

/// True where a trunk can rise from the origin to a sixteenth of `height_m`, leaning by 45 degrees at most.
bool leaves_room_for_trunk(const Volume& volume, double height_m);

}  // namespace espalier
