// The volume that pictures of a tree leave to it: what every camera sees inside of the tree's closed and
// filled outline. One picture says nothing of depth: there the tree is as deep as half its outline is wide at
// that height. Several give the visual hull [Laurentini 1994, The visual hull concept].
#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include <espalier/environment/volume.h>
#include <espalier/image/masks/mask.h>
#include <espalier/render/camera.h>

namespace espalier {

struct PictureOutline {
  Camera camera;
  Mask outline;  ///< of the camera's size
};

/// Throws InputError where an outline is empty.
std::unique_ptr<Volume> make_picture_envelope(const std::vector<PictureOutline>& outlines);

/// The volume of one picture of a shape, seen from the front, 1 m high, its lowest row on the ground and the
/// picture's middle at the origin. Throws InputError for what is no readable picture, or shows nothing.
std::unique_ptr<Volume> make_picture_volume(const std::filesystem::path& path);

}  // namespace espalier
