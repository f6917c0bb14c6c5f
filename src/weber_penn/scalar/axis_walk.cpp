#include <espalier/weber_penn/scalar/axis_walk.h>

namespace espalier {

namespace {

/// `v`, at a right angle to the unit vector `from`, turned along as `from` turns to `to` the shortest way.
Vec3 carried(Vec3 v, Vec3 from, Vec3 to) {
  const float one_and_cosine = 1 + dot(from, to);
  if (one_and_cosine < 1e-6f) return v;  // half a turn about v: any is as short
  return v - (from + to) * (dot(to, v) / one_and_cosine);
}

}  // namespace

AxisWalk::AxisWalk(const GrowingStem& stem, const WeberPennParameters& p)
    : curve_(stem.axis->curve),
      arcs_(curve_),
      extra_curve_(stem.extra_curve),
      index_(0),
      turtle_(stem.turtle) {
  const int segments = segment_count(p, stem.level);
  first_z_ = static_cast<float>(stem.first_segment) / static_cast<float>(segments);
  count_ = segment_count(stem, p) / segments * (segments - stem.first_segment);
  segment_m_ = stem.length_m * (1 - first_z_) / static_cast<float>(count_);
  metres_per_drawn_ = stem.length_m * (1 - first_z_) / arcs_.length();
  if (stem.axis->frame == AxisFrame::world) turtle_.forward = {0, 0, 1}, turtle_.right = {1, 0, 0};
  x_ = turtle_.right;
  y_ = cross(turtle_.forward, turtle_.right);
  z_ = turtle_.forward;
  turn_towards(direction_at(0));
  bend_axis_ = turtle_.right;
}

Vec3 AxisWalk::in_world(AxisPoint v) const {
  return x_ * static_cast<float>(v.x) + y_ * static_cast<float>(v.y) + z_ * static_cast<float>(v.z);
}

/// With the bend there.
Vec3 AxisWalk::direction_at(double share) const {
  const Vec3 drawn = in_world(arcs_.direction(arcs_.place_at(share)));
  const float deg = bend_deg(static_cast<float>(share));
  return normalized(deg == 0 ? drawn : rotated(drawn, bend_axis_, sine_cosine_deg(-deg)));
}

float AxisWalk::bend_deg(float z) const {
  return extra_curve_.whole_deg * z + extra_curve_.back_deg * std::fmax(0.f, 2 * z - 1);
}

void AxisWalk::turn_towards(Vec3 heading) {
  turtle_.right = carried(turtle_.right, turtle_.forward, heading);
  turtle_.forward = heading;
  turtle_.renormalize();
}

Segment AxisWalk::next() {
  const auto share_at = [&](float index) { return index / static_cast<float>(count_); };
  const auto z_at = [&](int index) {
    return first_z_ + (1 - first_z_) * share_at(static_cast<float>(index));
  };
  const float end = share_at(static_cast<float>(index_ + 1));
  const AxisPoint drawn_end = axis_point(curve_, arcs_.place_at(end));
  Vec3 chord_m = in_world((drawn_end - drawn_end_) * metres_per_drawn_);
  if (const float deg = bend_deg(share_at(static_cast<float>(index_) + 0.5f)); deg != 0)
    chord_m = rotated(chord_m, bend_axis_, sine_cosine_deg(-deg));
  Segment segment;
  segment.start_m = turtle_.position_m;
  segment.handle_out_m = segment.start_m + turtle_.forward * (segment_m_ / 3);
  turtle_.position_m += chord_m;
  turn_towards(direction_at(end));
  segment.end_m = turtle_.position_m;
  segment.handle_in_m = segment.end_m - turtle_.forward * (segment_m_ / 3);
  segment.z_start = z_at(index_);
  segment.z_end = index_ + 1 == count_ ? 1 : z_at(index_ + 1);
  segment.end = turtle_;
  drawn_end_ = drawn_end;
  ++index_;
  return segment;
}

}  // namespace espalier
