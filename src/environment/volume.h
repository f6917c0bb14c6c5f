// Volumes: closed regions of space that plants are pruned to or grow in. Metres, z up.
// Points on the surface of a box, ball or cylinder belong to it. On the command line a volume is
// text, read by parse_volume: "ball:0,0,4,3". Source: the pruning volumes of Figs 3.8 and 3.9 of the
// dissertation that the parametric model follows.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "core/vec3.h"

namespace espalier {

class Volume {
 public:
  virtual ~Volume() = default;
  /// True where the point lies inside. Safe to call from several threads at once.
  virtual bool contains(Vec3 point_m) const = 0;
  /// True only where the whole ball lies inside; false where that is not known.
  virtual bool surely_contains_ball(Vec3 center_m, float radius_m) const {
    (void)center_m, (void)radius_m;
    return false;
  }
};

/// An upright box. Throws InputError unless every size is positive and every number finite.
std::unique_ptr<Volume> make_box(Vec3 center_m, Vec3 size_m);

/// A ball. Throws InputError unless the radius is positive and every number finite.
std::unique_ptr<Volume> make_ball(Vec3 center_m, float radius_m);

/// A cylinder around the vertical through the middle of its bottom disc.
/// Throws InputError unless radius and height are positive and every number finite.
std::unique_ptr<Volume> make_cylinder(Vec3 base_center_m, float radius_m, float height_m);

/// The inside of a closed triangle mesh read with Assimp: obj, ply, stl, off, glb, gltf. Units are metres;
/// glTF's y up is turned to z up, the other formats are taken as z up. Where all triangles agree on which
/// side is out, inside is where the surface winds around (so parts may overlap); else where a ray leaves
/// through an odd number of triangles. Throws InputError for a file that is missing, no mesh, empty, or open.
std::unique_ptr<Volume> make_mesh_volume(const std::filesystem::path& path);

/// A volume from its command-line form: "box:cx,cy,cz,sx,sy,sz" (centre, sizes), "ball:cx,cy,cz,r",
/// "cylinder:cx,cy,cz,r,h" (middle of the bottom, radius, height) or "mesh:path.obj".
/// Throws InputError naming the text and what was expected.
std::unique_ptr<Volume> parse_volume(const std::string& text);

}  // namespace espalier
