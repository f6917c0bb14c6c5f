// What stands beside a plant in pictures, from its command-line form. Metres, z up.
#pragma once
#include <string>

#include <espalier/render/scene_objects.h>

namespace espalier {

/// Adds the object "mesh:FILE", a closed mesh as pruning volumes have it (volume.h): what a plant is pruned
/// to can be drawn beside it. Throws InputError with the text and what was expected where it
/// is none, or its file holds no such mesh.
void add_object(const std::string& text, SceneObjects& objects);

}  // namespace espalier
