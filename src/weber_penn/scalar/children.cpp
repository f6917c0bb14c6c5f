// Counts, spacing and orientation of children, see children.h.
#include <algorithm>
#include <cmath>
#include <span>

#include <espalier/weber_penn/scalar/children.h>
#include <espalier/weber_penn/table/shape_ratio.h>

namespace espalier {

namespace {

/// Heading along the curve; `right` as [CH §3.2.1]: (forward × right at the segment's end) × tangent, and
/// along a helix the turn of the tangent.
StemTurtle frame_at(const Segment& segment, float t) {
  StemTurtle frame;
  frame.position_m = segment_point(segment, t);
  frame.forward = segment_tangent(segment, t);
  const Vec3 right = segment.helical ? cross(segment_tangent(segment, t + 0.05f), frame.forward)
                                     : cross(cross(segment.end.forward, segment.end.right), frame.forward);
  frame.right = normalized(right, any_perpendicular(frame.forward));
  return frame;
}

}  // namespace

float child_stem_count(const GrowingStem& stem, const WeberPennParameters& p) {
  const int child_level = level_index(stem.level + 1);
  const float most = p.branches[child_level];
  if (most < 0) return most;
  float count = most;
  if (stem.level == 0)
    count *= 0.9f + 0.2f * draw_unit(stem.key, Draw::child_count);
  else if (stem.level == 1)
    count *= 0.2f + 0.8f * (stem.length_m / stem.parent_length_m) / stem.parent_child_max;
  else
    count *= 1 - 0.5f * stem.offset_m / stem.parent_length_m;
  return count / (1 - p.base_size[level_index(stem.level)]);
}

float leaf_count(const GrowingStem& stem, const WeberPennParameters& p) {
  if (p.leaf_blos_num < 0) return p.leaf_blos_num;
  const float count = p.leaf_blos_num * stem.tree.scale_m / p.g_scale;
  return stem.level == 0 ? count : count * stem.length_m / (stem.parent_child_max * stem.parent_length_m);
}

ChildPlacer::ChildPlacer(const GrowingStem& stem, Bears bears, const WeberPennParameters& parameters)
    : p_(parameters),
      bears_(bears),
      stem_(&stem),
      count_(changed(
          stem.cursor.change(), Quantity::child_count,
          bears == Bears::leaves ? leaf_count(stem, parameters) : child_stem_count(stem, parameters))),
      child_level_(level_index(stem.level + 1)),
      distribution_(parameters.branch_dist[child_level_]),
      spacing_(bears == Bears::leaves ? leaf_spacing(stem.level, parameters)
                                      : stem_spacing(stem.level, parameters)),
      rotation_deg_(360 * draw_unit(stem.key, Draw::child_rotation_start)) {}

void ChildPlacer::begin(const GrowingStem& stem, const Segment& segment) {
  const int segments = segment_count(p_, stem.level);
  stem_ = &stem;
  segment_ = &segment;
  steps_ = stem.axis ? segment_count(stem, p_) / segments : 1;
  const auto walked =
      steps_ > 1 ? static_cast<int>(std::lround(segment.z_start * static_cast<float>(segments * steps_))) : 0;
  step_ = walked % steps_;
  if (step_ > 0) return;
  last_segment_ = steps_ > 1 ? walked + steps_ == segments * steps_ : segment.z_end >= 1;
  const float grown_part = 1 - static_cast<float>(stem.first_segment) / static_cast<float>(segments);
  const float share = bears_ == Bears::leaves ? grown_part : stem.child_share;
  if (!spacing_.is_even()) {
    part_ = steps_ == 1 ? spacing_.part_of(segment.z_start, segment.z_end)
                        : spacing_.part_of(walked / steps_, segments);
    rate_ = std::max(0.f, count_) * share * part_.share();
    inverse_rate_ = 1 / rate_;
  } else if (share != share_) {
    share_ = share;
    rate_ = std::max(0.f, count_) * share / static_cast<float>(segments);
    inverse_rate_ = 1 / rate_;
  }
  before_ = reached_;
  reached_ += rate_;
  constexpr float kRounding = 1e-4f;  // of a running count of up to some hundreds in float
  whole_ = static_cast<int>(reached_ + kRounding);
}

bool ChildPlacer::next(ChildSite& site) {
  if (count_ < 0) return next_in_fan(site);
  for (ChildSlot slot; next_slot(slot);)
    if (site_at(slot, site)) return true;
  return false;
}

bool ChildPlacer::next_slot(ChildSlot& slot) {
  return distribution_ > 1 ? next_in_whorl(slot) : next_along(slot);
}

float ChildPlacer::along_segment(float share) const {
  const float inside = std::clamp(share, 0.f, 1.f);
  return spacing_.is_even() ? inside : spacing_.along(part_, inside);
}

bool ChildPlacer::next_run(ChildRun& run) {
  if (count_ < 0 || distribution_ > 1 || placed_ >= whole_) return false;
  run.first = placed_;
  run.count = std::min(whole_ - placed_, kMostInRun);
  const float shift = distribution_ * inverse_rate_;
  const bool starts_odd = run.first % 2 == 1;
  run.t_start = (static_cast<float>(run.first) - before_) * inverse_rate_ - (starts_odd ? shift : 0);
  run.t_step = inverse_rate_;
  run.t_odd = starts_odd ? shift : -shift;
  if (!spacing_.is_even()) put_apart(run);
  run.roll_deg = rolls_deg_.data();
  const auto rolls_deg = std::span(rolls_deg_).first(static_cast<std::size_t>(run.count));
  const float rotate = p_.rotate[child_level_];
  if (rotate < 0 || p_.rotate_v[child_level_] != 0) {
    for (float& roll_deg : rolls_deg) roll_deg = next_rotation_deg(), ++placed_;
    return true;
  }
  float rotation_deg = rotation_deg_;  // next_rotation_deg, without its choices
  for (float& roll_deg : rolls_deg) {
    rotation_deg += rotate;
    if (rotation_deg > 360) rotation_deg -= 360;
    roll_deg = rotation_deg;
  }
  rotation_deg_ = rotation_deg;
  placed_ += run.count;
  return true;
}

/// The places of children that are not evenly spaced.
void ChildPlacer::put_apart(ChildRun& run) {
  for (int k = 0; k < run.count; ++k) {
    const float even = run.t_start + static_cast<float>(k) * run.t_step + (k % 2 == 1 ? run.t_odd : 0);
    places_[static_cast<std::size_t>(k)] = along_segment(even);
  }
  run.t = places_.data();
}

bool ChildPlacer::next_along(ChildSlot& slot) {
  if (!(rate_ > 0)) return false;
  const float missing = static_cast<float>(placed_ + 1) - reached_;
  const bool is_whole = placed_ < whole_;
  const bool relaxed_last = p_.relaxed_counts > 0 && last_segment_ && missing < 1;
  if (!is_whole && !relaxed_last) return false;
  const float shift = placed_ % 2 == 1 ? distribution_ : 0;  // 1: opposite the one before it
  const float t = along_segment((static_cast<float>(placed_) - shift - before_) * inverse_rate_);
  if (is_further_on(t)) return false;
  slot = {placed_, on_step(t), next_rotation_deg(), is_whole ? 1 : 1 - missing};
  ++placed_;
  return true;
}

/// Whorls of branch_dist + 1 children, the rounding diffused from whorl to whorl.
bool ChildPlacer::next_in_whorl(ChildSlot& slot) {
  const float size = distribution_ + 1;
  while (rate_ > 0) {
    const float whorl_center = (static_cast<float>(whorl_) + 0.5f) * size;
    if (static_cast<float>(whorl_ + 1) * size > reached_) return false;
    const int members = static_cast<int>((whorl_ + 1) * size) - static_cast<int>(whorl_ * size);
    if (in_whorl_ >= members) {
      ++whorl_;
      in_whorl_ = 0;
      rotation_deg_ += p_.rotate[child_level_];
      continue;
    }
    const float t = along_segment((whorl_center - before_) * inverse_rate_);
    if (is_further_on(t)) return false;
    const float roll_deg =
        rotation_deg_ + 360.f * static_cast<float>(in_whorl_++) / members + jitter_deg(placed_);
    slot = {placed_++, on_step(t), roll_deg, 1};
    return true;
  }
  return false;
}

/// The variation of the rotation about the parent.
float ChildPlacer::jitter_deg(int index) const {
  const float most = p_.rotate_v[child_level_];
  return most == 0 ? 0 : draw_signed(stem_->key, Draw::child_rotation, index) * most;
}

/// |count| children from the tip, spread over the angle `rotate` in the plane of the stem.
bool ChildPlacer::next_in_fan(ChildSite& site) {
  const int members = static_cast<int>(std::ceil(-count_));
  if (segment_->z_end < 1 || placed_ >= members) return false;
  site.index = placed_;
  site.grown_fraction = std::min(1.f, -count_ - static_cast<float>(placed_));
  const float across = members > 1 ? static_cast<float>(placed_) / static_cast<float>(members - 1) - 0.5f : 0;
  site.offset_m = stem_->length_m;
  site.parent_radius_m = stem_radius_m(*stem_, 1, p_);
  site.turtle = segment_->end;
  site.outward = segment_->end.forward;
  site.turtle.turn_right(p_.rotate[child_level_] * across + jitter_deg(placed_));
  site.turtle.pitch_down(down_angle_deg(stem_->length_m, placed_));
  site.turtle.renormalize();
  ++placed_;
  return true;
}

bool ChildPlacer::site_at(const ChildSlot& slot, ChildSite& site) const {
  if (!is_borne(slot, z_of(slot))) return false;
  site = place(slot, *segment_, slot.t, nullptr);
  return true;
}

ChildSite ChildPlacer::place(const ChildSlot& slot, const Segment& segment, float t,
                             const BranchChange* change) const {
  const float z = segment.z_start + t * (segment.z_end - segment.z_start);
  ChildSite site;
  site.index = slot.index;
  site.grown_fraction = slot.grown_fraction;
  site.offset_m = z * stem_->length_m;
  site.parent_radius_m = stem_radius_m(*stem_, z, p_);
  site.turtle = frame_at(segment, t);
  site.turtle.roll_right(changed(change, Quantity::rotation, slot.roll_deg));
  site.outward = cross(site.turtle.forward, site.turtle.right);
  site.turtle.pitch_down(changed(change, Quantity::down_angle, down_angle_deg(site.offset_m, slot.index)));
  site.turtle.renormalize();
  return site;
}

/// rotate ≥ 0: further round than the one before; < 0: alternate sides, that far from the downward direction.
float ChildPlacer::next_rotation_deg() {
  const float rotate = p_.rotate[child_level_];
  if (rotate < 0) return (placed_ % 2 == 0 ? 1.f : -1.f) * (180 + rotate + jitter_deg(placed_));
  rotation_deg_ += rotate + jitter_deg(placed_);
  if (rotation_deg_ > 360) rotation_deg_ -= 360;
  return rotation_deg_;
}

float ChildPlacer::down_angle_deg(float offset_m, int index) const {
  const AlongCurve& along = p_.curves.down_angle_along[child_level_];
  const float drawn_deg = drawn_down_angle_deg(offset_m, index);
  return along.is_neutral ? drawn_deg : drawn_deg + along.at(place_above_base(*stem_, offset_m, p_));
}

/// down_angle_v < 0: the angle changes along the parent by the conical shape, then ±10 % [WP §4.3].
float ChildPlacer::drawn_down_angle_deg(float offset_m, int index) const {
  const float angle = p_.down_angle[child_level_], variation = p_.down_angle_v[child_level_];
  const float jitter = draw_signed(stem_->key, Draw::child_down_angle, index);
  if (variation >= 0) return angle + jitter * variation;
  const float bare_m = stem_->length_m * (1 - p_.base_size[level_index(stem_->level)]);
  const float ratio = (stem_->length_m - offset_m) / bare_m;
  const float shaped = angle + variation * (1 - 2 * shape_ratio(0, ratio, p_));
  return shaped * (1 + 0.1f * jitter);
}

}  // namespace espalier
