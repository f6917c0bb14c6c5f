// Volumes: closed regions of space that plants are pruned to or grow in. Metres, z up.
// Points on the surface of a box, ball or cylinder belong to it. On the command line and in L-system files a
// volume is text: "ball:0,0,4,3" or "union(ball(0,0,4,3), box(0,0,1,2,2,2))" (volume_tree.h). Sources: the
// pruning volumes of Figs 3.8 and 3.9 of the dissertation that the parametric model follows, and the clipping
// forms of Prusinkiewicz, James, Měch 1994, Synthetic Topiary, §6.
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <espalier/core/vec3.h>

namespace espalier {

/// What a question to a volume takes: how many simple ones may be asked for it, and how deep calls go.
struct VolumeSize {
  double parts = 1;
  int depth = 1;
};

class Volume {
 public:
  virtual ~Volume() = default;
  /// True where the point lies inside. Safe to call from several threads at once.
  virtual bool contains(Vec3 point_m) const = 0;
  /// Distance to the surface, negative inside. Exact outside of box, ball, cylinder, mesh and their unions;
  /// elsewhere an estimate with the right sign. Safe to call from several threads at once.
  virtual float signed_distance_m(Vec3 point_m) const = 0;
  /// True only where the whole ball lies inside; false where that is not known.
  virtual bool surely_contains_ball(Vec3 center_m, float radius_m) const {
    (void)center_m, (void)radius_m;
    return false;
  }
  /// Known once it is made: asking is cheap.
  virtual VolumeSize size() const { return {}; }
};

/// An upright box. Throws InputError unless every size is positive and every number finite.
std::unique_ptr<Volume> make_box(Vec3 center_m, Vec3 size_m);

/// A ball. Throws InputError unless the radius is positive and every number finite.
std::unique_ptr<Volume> make_ball(Vec3 center_m, float radius_m);

/// A cylinder around the vertical through the middle of its bottom disc.
/// Throws InputError unless radius and height are positive and every number finite.
std::unique_ptr<Volume> make_cylinder(Vec3 base_center_m, float radius_m, float height_m);

/// An ellipsoid with these radii along the axes. Throws InputError unless they are positive and all is
/// finite.
std::unique_ptr<Volume> make_ellipsoid(Vec3 center_m, Vec3 radius_m);

/// A line with a thickness that goes from one radius to the other, round at its ends.
/// Throws InputError unless both radii are positive and every number finite.
std::unique_ptr<Volume> make_line(Vec3 from_m, Vec3 to_m, float from_radius_m, float to_radius_m);

/// A tube along a helico-spiral that winds up around the vertical through the base, as a seashell's: each
/// turn is `shrink` times as wide, thick and high as the one below it. Source: Fowler, Meinhardt,
/// Prusinkiewicz 1992, Modeling seashells, §3.1.
struct SpiralShape {
  Vec3 base_m;  ///< below the middle of the tube's begin, where its axis meets the ground
  float height_m = 1, turns = 1;
  float radius_m = 1, tube_radius_m = 0.5f;  ///< of the lowest turn, and of the tube there
  float shrink = 1;                          ///< 1: an ordinary helix
};
/// Throws InputError unless sizes are positive, shrink is at most 1, turns at most 100, all finite.
std::unique_ptr<Volume> make_spiral(const SpiralShape& shape);

using VolumePtr = std::shared_ptr<const Volume>;

/// What is in any, in all, or in the first and in no other of them. None may be null; there is at least one.
std::unique_ptr<Volume> make_union(std::vector<VolumePtr> parts);
std::unique_ptr<Volume> make_intersection(std::vector<VolumePtr> parts);
std::unique_ptr<Volume> make_difference(std::vector<VolumePtr> parts);

/// The union with smooth joints: an implicit surface about its parts as a skeleton. Each part has the field
/// of Wyvill, McPheeters, Wyvill 1986 (Data structure for soft objects, Eq. 1), 1/2 on its surface, 0 from
/// `width_m` outside of it and 1 from there inside; the fields add up, and 1/2 is the surface.
/// Throws InputError unless the width is positive.
std::unique_ptr<Volume> make_blend(float width_m, std::vector<VolumePtr> parts);

/// A volume moved; scaled about the origin by a factor above 0; turned about the vertical, seen from above
/// against the clock. Throw InputError where a number is not finite or the factor not positive.
std::unique_ptr<Volume> make_moved(Vec3 by_m, VolumePtr part);
std::unique_ptr<Volume> make_scaled(float factor, VolumePtr part);
std::unique_ptr<Volume> make_turned(float angle_deg, VolumePtr part);

/// The inside of a closed triangle mesh read with Assimp: obj, ply, stl, off, glb, gltf. Units are metres;
/// glTF's y up is turned to z up, the other formats are taken as z up. Where all triangles agree on which
/// side is out, inside is where the surface winds around (so parts may overlap); else where a ray leaves
/// through an odd number of triangles. Throws InputError for a file that is missing, no mesh, empty, or open.
std::unique_ptr<Volume> make_mesh_volume(const std::filesystem::path& path);

/// A volume from its command-line form: "box:cx,cy,cz,sx,sy,sz" (centre, sizes), "ball:cx,cy,cz,r",
/// "cylinder:cx,cy,cz,r,h" (middle of the bottom, radius, height), "mesh:path.obj", or an expression of
/// volume_tree.h with plain numbers and any path.
/// Throws InputError naming the text and what was expected.
std::unique_ptr<Volume> parse_volume(const std::string& text);

}  // namespace espalier
