#include <espalier/lsystem/drawing/copy_plant.h>
#include <espalier/plant/leaf_outlines.h>

namespace espalier::lsystem {

namespace {

/// The factor for radii: a frame may stretch the plant across and along differently.
float width_factor(const CopyFrame& frame) { return length(frame.x_m); }

PartColor color_of(const std::vector<PartColor>& colors, std::size_t i) {
  return colors.empty() ? PartColor{} : colors[i];
}

void copy_leaf(const Leaves& from, std::size_t i, const CopyFrame& frame, Leaves& to) {
  const Vec3 along_m = frame.direction_m(from.axis[i]), across_m = frame.direction_m(from.side[i]);
  to.position_m.push_back(frame.point_m(from.position_m[i]));
  to.axis.push_back(normalized(along_m));
  to.side.push_back(normalized(across_m));
  to.length_m.push_back(from.length_m[i] * length(along_m));
  to.width_m.push_back(from.width_m[i] * length(across_m));
  to.kind.push_back(from.kind[i]);
  const PartColor color = color_of(from.color, i);
  if (color.is_set && to.color.empty()) to.color.resize(to.size() - 1);
  if (color.is_set || !to.color.empty()) to.color.push_back(color);
}

void copy_as_triangles(const Leaves& from, std::size_t i, const LeafOutline& outline, const CopyFrame& frame,
                       std::uint32_t organ, std::vector<ColoredTriangle>& triangles) {
  const Vec3 x = from.side[i] * from.width_m[i], y = from.axis[i] * from.length_m[i],
             z = cross(from.side[i], from.axis[i]) * from.length_m[i];
  const auto corner = [&](std::size_t vertex) {
    const Vec3 v = outline.vertices[vertex];
    return frame.point_m(from.position_m[i] + x * v.x + y * v.y + z * v.z);
  };
  const bool is_plain = !from.shade.empty() && from.shade[i] == kPlainShade;
  for (const auto& [a, b, c] : outline.triangles)
    triangles.push_back({{corner(a), corner(b), corner(c)}, color_of(from.color, i), organ, is_plain});
}

}  // namespace

bool is_copied_as_leaves(const Plant& plant, int leaf_shape) {
  return plant.leaf_shape == leaf_shape && plant.leaves.shade.empty();
}

std::vector<std::int32_t> copy_stems(const JointedPlant& from, const CopyFrame& frame, std::int32_t parent,
                                     StemSplines& stems) {
  const Plant& plant = from.plant;
  std::vector<std::int32_t> copies;
  for (std::size_t s = 0; s < plant.stems.size(); ++s) {
    const std::int32_t own_parent = plant.stems.parent[s];
    copies.push_back(own_parent < 0 ? stems.add_stem(parent)
                                    : stems.add_stem(copies[static_cast<std::size_t>(own_parent)],
                                                     from.joints.stem_place[s]));
    for (std::uint32_t k = plant.stems.first_knot[s]; k + 1 < plant.stems.first_knot[s + 1]; ++k) {
      const float radius_m = width_factor(frame) * plant.knots.radius_m[k],
                  next_radius_m = width_factor(frame) * plant.knots.radius_m[k + 1];
      stems.start_segment(copies.back(), frame.point_m(plant.knots.point_m[k]), radius_m,
                          color_of(plant.knots.color, k));
      stems.end_segment(copies.back(), frame.point_m(plant.knots.point_m[k + 1]), next_radius_m);
    }
  }
  return copies;
}

void copy_organs(const JointedPlant& from, const std::vector<std::int32_t>& copies, const Organ& base,
                 std::vector<Organ>& organs) {
  for (const Organ& organ : from.joints.organs)
    organs.push_back(organ.stem < 0 ? base
                                    : Organ{copies[static_cast<std::size_t>(organ.stem)], organ.place});
}

void copy_leaves(const JointedPlant& from, const CopyFrame& frame, int leaf_shape, std::uint32_t first_organ,
                 Leaves& leaves, std::vector<std::uint32_t>& organ_of_leaf,
                 std::vector<ColoredTriangle>& triangles) {
  const Plant& plant = from.plant;
  const LeafOutline& outline = leaf_outline(plant.leaf_shape);
  for (std::size_t i = 0; i < plant.leaves.size(); ++i) {
    const std::uint32_t organ = first_organ + from.joints.organ_of_leaf[i];
    if (plant.leaves.kind[i] != LeafKind::blossom && !is_copied_as_leaves(plant, leaf_shape)) {
      copy_as_triangles(plant.leaves, i, outline, frame, organ, triangles);
      continue;
    }
    copy_leaf(plant.leaves, i, frame, leaves);
    organ_of_leaf.push_back(organ);
  }
}

}  // namespace espalier::lsystem
