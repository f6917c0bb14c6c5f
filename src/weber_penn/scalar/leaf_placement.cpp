// Size, kind and bend of leaves, see leaf_placement.h.
#include <cmath>

#include <espalier/weber_penn/scalar/leaf_placement.h>

namespace espalier {

namespace {

/// leaf_bend turns the leaf about z so that its normal faces away from the trunk, by that fraction of the
/// angle [Weber & Penn 95, §4.9].
void bend_outwards(StemTurtle& leaf, float leaf_bend) {
  const Vec3 normal = cross(leaf.right, leaf.forward);
  const float outward = std::atan2(leaf.position_m.y, leaf.position_m.x);
  const float facing = std::atan2(normal.y, normal.x);
  leaf.rotate_about({0, 0, 1}, leaf_bend * std::remainder(degrees(outward - facing), 360.f));
}

}  // namespace

LeafKind leaf_kind(const GrowingStem& stem, int index, const WeberPennParameters& p) {
  const bool is_blossom =
      p.blossom_rate > 0 && draw_unit(child_key(stem.key, index), Draw::blossom) < p.blossom_rate;
  return is_blossom ? LeafKind::blossom : LeafKind::leaf;
}

float leaf_growth(const GrowingStem& stem, float grown_fraction, const WeberPennParameters& p) {
  return grown_fraction * stem.tree.scale_m / p.g_scale;
}

void place_leaf(const GrowingStem& stem, const ChildSite& site, const WeberPennParameters& p,
                Leaves& leaves) {
  StemTurtle leaf = site.turtle;
  leaf.position_m += site.outward * site.parent_radius_m;
  if (p.leaf_bend > 0) bend_outwards(leaf, p.leaf_bend);
  leaves.position_m.push_back(leaf.position_m);
  leaves.axis.push_back(leaf.forward);
  leaves.side.push_back(leaf.right);
  const bool is_leaf = leaf_kind(stem, site.index, p) == LeafKind::leaf;
  const AlongCurve& along = p.curves.leaf_scale_along;
  const float growth = leaf_growth(stem, site.grown_fraction, p),
              factor = along.is_neutral ? 1 : along.at(place_above_base(stem, site.offset_m, p));
  const float length_m = (is_leaf ? p.leaf_scale : p.blossom_scale) * (growth * factor);
  leaves.length_m.push_back(length_m);
  leaves.width_m.push_back(length_m * (is_leaf ? p.leaf_scale_x : 1));
  leaves.kind.push_back(is_leaf ? LeafKind::leaf : LeafKind::blossom);
}

}  // namespace espalier
