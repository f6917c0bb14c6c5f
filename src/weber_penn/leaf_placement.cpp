// Size, kind and bend of leaves, see leaf_placement.h.
#include "weber_penn/leaf_placement.h"

#include <cmath>

namespace espalier {

namespace {

/// leaf_bend turns the leaf about z so that its normal faces away from the trunk, by that fraction of the
/// angle [Weber & Penn 95, §4.9].
void bend_outwards(Turtle& leaf, float leaf_bend) {
  const Vec3 normal = cross(leaf.right, leaf.forward);
  const float outward = std::atan2(leaf.position_m.y, leaf.position_m.x);
  const float facing = std::atan2(normal.y, normal.x);
  leaf.rotate_about({0, 0, 1}, leaf_bend * std::remainder(degrees(outward - facing), 360.f));
}

}  // namespace

void append_leaf_size(const GrowingStem& stem, int index, float grown_fraction, const WeberPennParameters& p,
                      Leaves& leaves) {
  const bool is_blossom =
      p.blossom_rate > 0 && draw_unit(child_key(stem.key, index), Draw::blossom) < p.blossom_rate;
  const float growth = grown_fraction * stem.tree.scale_m / p.g_scale;
  const float length_m = (is_blossom ? p.blossom_scale : p.leaf_scale) * growth;
  leaves.length_m.push_back(length_m);
  leaves.width_m.push_back(is_blossom ? length_m : length_m * p.leaf_scale_x);
  leaves.kind.push_back(is_blossom ? LeafKind::blossom : LeafKind::leaf);
}

void place_leaf(const GrowingStem& stem, const ChildSite& site, const WeberPennParameters& p,
                Leaves& leaves) {
  Turtle leaf = site.turtle;
  leaf.position_m += site.outward * site.parent_radius_m;
  if (p.leaf_bend > 0) bend_outwards(leaf, p.leaf_bend);
  leaves.position_m.push_back(leaf.position_m);
  leaves.axis.push_back(leaf.forward);
  leaves.side.push_back(leaf.right);
  append_leaf_size(stem, site.index, site.grown_fraction, p, leaves);
}

}  // namespace espalier
