// Spacing and rolls of whole stems, see child_spread.h; the formulas are those of children.cpp.
#include <algorithm>

#include <espalier/weber_penn/simd/child_spread.h>

namespace espalier {

namespace {

constexpr std::size_t kReadBeyond = 16;
constexpr float kRounding = 1e-4f;  // of a running count, as in ChildPlacer::begin

float alternating_deg(int child, float rotate_deg) {
  return (child % 2 == 0 ? 1.f : -1.f) * (180 + rotate_deg);
}

}  // namespace

bool ChildSpread::supports(float child_count, int child_level, const WeberPennParameters& p) {
  return child_count >= 0 && p.branch_dist[level_index(child_level)] <= 1;
}

/// The place of a child, in [0, 1] along the stem.
float ChildSpread::place(int child, int segments) const {
  std::size_t segment = 0;
  while (segment + 1 < static_cast<std::size_t>(segments) && static_cast<float>(child) >= whole_[segment])
    ++segment;
  const float shift = child % 2 == 1 ? distribution_ : 0;
  const float t =
      are_placed_
          ? places_[static_cast<std::size_t>(child)]
          : std::clamp((static_cast<float>(child) - shift - reached_[segment]) * inverse_rate_, 0.f, 1.f);
  const float z_start = static_cast<float>(segment) / static_cast<float>(segments),
              z_end = static_cast<float>(segment + 1) / static_cast<float>(segments);
  return z_start + t * (z_end - z_start);
}

/// Counts from segment to segment, `rate` children on each; the whole count.
template <typename Rate>
float ChildSpread::pass(int segments, const Rate& rate) {
  reached_.resize(static_cast<std::size_t>(segments) + kReadBeyond);
  whole_.resize(static_cast<std::size_t>(segments) + kReadBeyond);
  float reached = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(segments); ++i) {
    reached_[i] = reached;
    reached += rate(i);
    end_ = static_cast<int>(reached + kRounding);
    whole_[i] = static_cast<float>(end_);
  }
  return reached;
}

void ChildSpread::share_parts(int level, const ChildSpacing& spacing, int segments) {
  if (!parts_.empty() && level == level_) return;
  level_ = level;
  parts_.clear();
  parts_.reserve(static_cast<std::size_t>(segments));
  for (int i = 0; i < segments; ++i) parts_.push_back(spacing.part_of(i, segments));
}

/// Works out where each child is, also one that is not whole.
void ChildSpread::put_apart(float count, const ChildSpacing& spacing) {
  places_.resize(static_cast<std::size_t>(end_) + kReadBeyond);
  int child = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const ChildSpacing::Part part = parts_[i];
    const float per_child = 1 / (count * part.share()), reached = reached_[i];
    const int end = i + 1 == parts_.size() ? end_ : static_cast<int>(whole_[i]);
    for (; child < end; ++child) {
      const float shift = child % 2 == 1 ? distribution_ : 0;
      const float share = (static_cast<float>(child) - shift - reached) * per_child;
      places_[static_cast<std::size_t>(child)] = spacing.along(part, std::clamp(share, 0.f, 1.f));
    }
  }
}

void ChildSpread::spread(const GrowingStem& stem, float child_count, const ChildSpacing& spacing,
                         const WeberPennParameters& p) {
  const int segments = segment_count(p, stem.level);
  const float count = std::max(0.f, child_count), even_rate = count / static_cast<float>(segments);
  are_placed_ = !spacing.is_even();
  inverse_rate_ = 1 / even_rate;
  distribution_ = p.branch_dist[level_index(stem.level + 1)];
  if (are_placed_) share_parts(stem.level, spacing, segments);
  const auto rate = [&](std::size_t i) { return are_placed_ ? count * parts_[i].share() : even_rate; };
  const float reached = pass(segments, rate);
  first_ = 0;
  last_growth_ = 1;
  const float missing = static_cast<float>(end_ + 1) - reached;
  const float last_rate = rate(static_cast<std::size_t>(segments - 1));
  if (last_rate > 0 && p.relaxed_counts > 0 && missing < 1) ++end_, last_growth_ = 1 - missing;
  if (are_placed_) put_apart(count, spacing);
  const float bare = p.base_size[level_index(stem.level)];
  while (first_ < end_ && place(first_, segments) < bare) ++first_;
}

void RollTable::extend_shared(std::size_t count, float rotate_deg) {
  while (shared_deg_.size() < count + kReadBeyond) {
    const int child = static_cast<int>(shared_deg_.size());
    float roll_deg = rotate_deg < 0 ? alternating_deg(child, rotate_deg)
                                    : (child == 0 ? 0 : shared_deg_.back()) + rotate_deg;
    if (roll_deg > 360) roll_deg -= 360;
    shared_deg_.push_back(roll_deg);
  }
}

/// ChildPlacer::next_rotation_deg of each child.
void RollTable::draw_own(const GrowingStem& stem, int count, float rotate_deg, float most_deg) {
  own_deg_.resize(static_cast<std::size_t>(count) + kReadBeyond);
  float rotation_deg = 360 * draw_unit(stem.key, Draw::child_rotation_start);
  for (int child = 0; child < count; ++child) {
    const float jitter_deg = draw_signed(stem.key, Draw::child_rotation, child) * most_deg;
    rotation_deg += rotate_deg + jitter_deg;
    if (rotation_deg > 360) rotation_deg -= 360;
    own_deg_[static_cast<std::size_t>(child)] =
        rotate_deg < 0 ? (child % 2 == 0 ? 1.f : -1.f) * (180 + rotate_deg + jitter_deg) : rotation_deg;
  }
}

ChildRolls RollTable::rolls(const GrowingStem& stem, int count, const WeberPennParameters& p) {
  const int level = level_index(stem.level + 1);
  const float rotate_deg = p.rotate[level], most_deg = p.rotate_v[level];
  if (most_deg != 0) {
    draw_own(stem, count, rotate_deg, most_deg);
    return {0, own_deg_.data()};
  }
  if (stem.level != level_) shared_deg_.clear();
  level_ = stem.level;
  extend_shared(static_cast<std::size_t>(count), rotate_deg);
  return {rotate_deg < 0 ? 0 : 360 * draw_unit(stem.key, Draw::child_rotation_start), shared_deg_.data()};
}

}  // namespace espalier
