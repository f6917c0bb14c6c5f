#include <algorithm>
#include <cmath>

#include <espalier/weber_penn/scalar/stem_walk.h>
#include <espalier/weber_penn/tree_crown.h>

namespace espalier {

namespace {

/// Of the tips of a stem and its clones, how long the stem is where the first one meets the envelope.
class TipWalk : public StemVisitor {
 public:
  TipWalk(const GrowingStem& stem, const PlacedCrown& crown, const WeberPennParameters& p)
      : stem_(stem), crown_(crown), p_(p) {}

  bool segment(const GrowingStem&, const Segment& segment) override {
    if (segment.z_end < 1) return true;
    const Vec3 away = (segment.end_m - stem_.turtle.position_m) * (1 / stem_.length_m);  // per length
    constexpr float kLeastAway = 0.25f;
    const Vec3 direction = normalized(away, stem_.turtle.forward);
    length_m_ = std::min(
        length_m_, crown_.reach_m(stem_.turtle.position_m, direction) / std::max(length(away), kLeastAway));
    return true;
  }
  void split(const GrowingStem& clone) override { walk_stem(clone, parameters_of(clone, p_), *this); }

  float length_m() const { return std::isfinite(length_m_) ? length_m_ : 0; }

 private:
  const GrowingStem& stem_;
  const PlacedCrown& crown_;
  const WeberPennParameters& p_;
  float length_m_ = INFINITY;
};

class OwnTip : public StemVisitor {
 public:
  bool segment(const GrowingStem&, const Segment& segment) override {
    tip_m = segment.end_m;
    return true;
  }
  void split(const GrowingStem&) override {}

  Vec3 tip_m;
};

/// Of an apex that lies as many radii of its side away.
float offset_m(float share, float positive_radius_m, float negative_radius_m) {
  return share * (share > 0 ? positive_radius_m : negative_radius_m);
}

/// The inverse of offset_m().
float share_of_offset(float offset_m, float positive_radius_m, float negative_radius_m) {
  return offset_m / (offset_m > 0 ? positive_radius_m : negative_radius_m);
}

}  // namespace

CrownShape crown_shape(const WeberPennParameters& p, float tree_scale_m) {
  CrownShape crown;
  crown.radius_m = {p.crown_radius_right * tree_scale_m, p.crown_radius_back * tree_scale_m,
                    p.crown_radius_left * tree_scale_m, p.crown_radius_front * tree_scale_m};
  const auto apex = [&](float x, float y, float height_m) {
    return Vec3{offset_m(x, crown.radius_m[0], crown.radius_m[2]),
                offset_m(y, crown.radius_m[1], crown.radius_m[3]), height_m};
  };
  crown.top_m = apex(p.crown_top_x, p.crown_top_y, p.crown_top * tree_scale_m);
  crown.bottom_m = apex(p.crown_bottom_x, p.crown_bottom_y, p.crown_bottom * crown.top_m.z);
  const std::array rim{p.crown_rim_right, p.crown_rim_back, p.crown_rim_left, p.crown_rim_front};
  for (std::size_t side = 0; side < rim.size(); ++side)
    crown.rim_m[side] = std::lerp(crown.bottom_m.z, crown.top_m.z, rim[side]);
  crown.shape_above = p.crown_shape_above;
  crown.shape_below = p.crown_shape_below;
  return crown;
}

void set_crown_rows(const CrownShape& crown, ParameterValues& values) {
  const ParameterTable& table = weber_penn_table();
  const float scale_m = static_cast<float>(values[table.index_of("g_scale")]);
  const auto set = [&](std::string_view name, float value) {
    const std::size_t row = table.index_of(name);
    values[row] = nearest_valid_value(table.rows[row], value);
  };
  const auto [right_m, back_m, left_m, front_m] = crown.radius_m;
  set("crown_top", crown.top_m.z / scale_m);
  set("crown_top_x", share_of_offset(crown.top_m.x, right_m, left_m));
  set("crown_top_y", share_of_offset(crown.top_m.y, back_m, front_m));
  set("crown_bottom", crown.bottom_m.z / crown.top_m.z);
  set("crown_bottom_x", share_of_offset(crown.bottom_m.x, right_m, left_m));
  set("crown_bottom_y", share_of_offset(crown.bottom_m.y, back_m, front_m));
  constexpr std::array kSides{"right", "back", "left", "front"};
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    const float rim = (crown.rim_m[side] - crown.bottom_m.z) / (crown.top_m.z - crown.bottom_m.z);
    set(std::string("crown_radius_") + kSides[side], crown.radius_m[side] / scale_m);
    set(std::string("crown_rim_") + kSides[side], rim);
  }
  set("crown_shape_above", crown.shape_above);
  set("crown_shape_below", crown.shape_below);
}

float length_to_crown_m(const GrowingStem& stem, const PlacedCrown& crown, const WeberPennParameters& p) {
  GrowingStem measured = stem;
  measured.length_m = 1;
  TipWalk tips(measured, crown, p);
  walk_stem(measured, p, tips);
  return tips.length_m();
}

Vec3 tip_m(const GrowingStem& stem, const WeberPennParameters& p) {
  OwnTip tip;
  walk_stem(stem, p, tip);
  return tip.tip_m;
}

TreeCrown::TreeCrown(const WeberPennParameters& p, float tree_scale_m) {
  if (p.crown_use == 0 || !(tree_scale_m > 0)) return;
  use_ = static_cast<CrownUse>(p.crown_use);
  crown_.emplace(crown_shape(p, tree_scale_m));
  trunk_room_.emplace(crown_->envelope());
}

const Volume* TreeCrown::volume(int level) const {
  if (!crown_) return nullptr;
  if (use_ == CrownUse::length && level < 2) return nullptr;
  return level == 0 ? static_cast<const Volume*>(&*trunk_room_) : &*crown_;
}

const PlacedCrown* TreeCrown::gives_lengths(int level) const {
  return use_ == CrownUse::length && level == 1 ? &*crown_ : nullptr;
}

bool TreeCrown::TrunkRoom::contains(Vec3 point_m) const {
  return point_m.z <= crown_.shape().bottom_m.z || crown_.is_under_top(point_m);
}

float TreeCrown::TrunkRoom::signed_distance_m(Vec3 point_m) const {
  const float below_m = point_m.z - crown_.shape().bottom_m.z, outside_m = crown_.signed_distance_m(point_m);
  const float distance_m = std::min(below_m, outside_m);
  return contains(point_m) ? std::min(distance_m, 0.f) : std::max(distance_m, 0.f);
}

}  // namespace espalier
