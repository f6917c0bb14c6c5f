// The test pass of pruning: the stem is walked with the same draws at ever shorter lengths.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <espalier/weber_penn/scalar/pruning.h>
#include <espalier/weber_penn/table/shape_ratio.h>

namespace espalier {

namespace {

class InsideTest : public StemVisitor {
 public:
  InsideTest(const WeberPennParameters& p, const Volume* volume) : p_(p), volume_(volume) {}

  bool segment(const GrowingStem& stem, const Segment& segment) override {
    const bool exempt = stem.level == 0 && segment.z_end * stem.length_m <= stem.tree.base_length_m;
    if (!exempt && !contains(stem, segment.end_m)) inside_ = false;
    if (!exempt && volume_ && !volume_->contains(segment_point(segment, 0.5f))) inside_ = false;
    return inside_;
  }

  /// The published implementation tests a stem without its clones, and the species were tuned for that;
  /// a volume that the user gives holds them too.
  void split(const GrowingStem& clone) override {
    if (volume_ && inside_) walk_stem(clone, parameters_of(clone, p_), *this);
  }

  bool inside() const { return inside_; }

 private:
  bool contains(const GrowingStem& stem, Vec3 point_m) const {
    return volume_ ? volume_->contains(point_m) : inside_envelope(point_m, stem.tree.scale_m, p_);
  }

  const WeberPennParameters& p_;
  const Volume* volume_;
  bool inside_ = true;
};

/// No point of a stem that does not wind is further from its start than it is long.
bool surely_fits(const GrowingStem& stem, const WeberPennParameters& p) {
  constexpr float kRounding = 1.001f;
  return stem.level > 0 && p.curve_v[level_index(stem.level)] >= 0 &&
         ball_inside_envelope(stem.turtle.position_m, kRounding * stem.length_m, stem.tree.scale_m, p);
}

bool surely_fits(const GrowingStem& stem, const WeberPennParameters& p, const Volume& volume) {
  constexpr float kRounding = 1.001f;
  return p.curve_v[level_index(stem.level)] >= 0 &&
         volume.surely_contains_ball(stem.turtle.position_m, kRounding * stem.length_m);
}

bool fits(const GrowingStem& stem, const WeberPennParameters& p, const Volume* volume) {
  if (volume == nullptr ? surely_fits(stem, p) : surely_fits(stem, p, *volume)) return true;
  InsideTest test(p, volume);
  walk_stem(stem, p, test);
  return test.inside();
}

constexpr float kShorter = 0.9f;         ///< the step of shortening
constexpr float kShortestUnbent = 0.6f;  ///< of its length, where a stem is bent instead
constexpr float kShortest = 0.15f;       ///< of its length, below which it is dropped

/// Finds the length at which a stem fits, in one walk: no angle depends on the length, so of a shorter stem
/// the points that InsideTest looks at are nearer to its start by as much.
class ShorteningWalk : public StemVisitor {
 public:
  /// Not below `shortest` times the stem's length.
  ShorteningWalk(const GrowingStem& stem, float shortest, const WeberPennParameters& p, const Volume& volume)
      : stem_(stem), p_(p), volume_(volume), length_m_(stem.length_m), shortest_m_(shortest * stem.length_m) {
    walk_stem(stem, p, *this);
  }

  bool segment(const GrowingStem&, const Segment& segment) override {
    if (is_over()) return false;
    if (count_ == kMostSegments) is_exact_ = false;
    if (count_ == kMostSegments) return false;
    const float per_metre = 1 / stem_.length_m;
    const Vec3 start_m = stem_.turtle.position_m;
    points_[count_] = {(segment_point(segment, 0.5f) - start_m) * per_metre,
                       (segment.end_m - start_m) * per_metre, segment.z_end};
    if (is_inside(points_[count_++])) return true;
    while (length_m_ >= shortest_m_ && !all_inside()) length_m_ *= kShorter;
    return !is_over();
  }
  void split(const GrowingStem& clone) override {
    is_exact_ &= clone.cursor.change() == nullptr;  // may have a length of its own
    if (!is_over()) walk_stem(clone, parameters_of(clone, p_), *this);
  }

  /// Not where an override changes a clone, or there are very many segments.
  bool is_exact() const { return is_exact_; }
  /// Less than the shortest where it fits at no length.
  float length_m() const { return length_m_; }

 private:
  static constexpr std::size_t kMostSegments = 128;
  struct Points {
    Vec3 middle, end;  ///< from the start, for a stem of one metre
    float z_end;
  };

  bool is_over() const { return length_m_ < shortest_m_; }
  bool is_inside(const Points& points) const {
    if (stem_.level == 0 && points.z_end * length_m_ <= stem_.tree.base_length_m) return true;
    const Vec3 start_m = stem_.turtle.position_m;
    return volume_.contains(start_m + points.end * length_m_) &&
           volume_.contains(start_m + points.middle * length_m_);
  }
  bool all_inside() const {
    return std::all_of(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(count_),
                       [&](const Points& points) { return is_inside(points); });
  }

  const GrowingStem& stem_;
  const WeberPennParameters& p_;
  const Volume& volume_;
  float length_m_, shortest_m_;
  bool is_exact_ = true;
  std::size_t count_ = 0;
  std::array<Points, kMostSegments> points_;
};

/// Shortens the stem until it fits; false where that takes it below `shortest` times its length.
bool shorten(GrowingStem& stem, float shortest, const WeberPennParameters& p, const Volume& volume) {
  if (surely_fits(stem, p, volume)) return true;
  const float shortest_m = shortest * stem.length_m;
  const ShorteningWalk walk(stem, shortest, p, volume);
  stem.length_m = walk.length_m();
  if (walk.is_exact()) return stem.length_m >= shortest_m;
  while (stem.length_m >= shortest_m && !fits(stem, p, &volume)) stem.length_m *= kShorter;
  return stem.length_m >= shortest_m;
}

}  // namespace

void train_stem(GrowingStem& stem, const WeberPennParameters& p, const Volume& volume) {
  GrowingStem trained = stem;
  if (!shorten(trained, kShortestUnbent, p, volume)) {
    constexpr float kBendsDeg[] = {25, -25, 50, -50, 80, -80, 120, -120};
    for (const float bend_deg : kBendsDeg) {
      trained = stem;
      trained.extra_curve.whole_deg += bend_deg;
      if (shorten(trained, kShortestUnbent, p, volume)) break;
      trained.length_m = 0;
    }
  }
  if (trained.length_m == 0) {
    trained = stem;
    if (!shorten(trained, kShortest, p, volume)) trained.length_m = 0;
  }
  stem.length_m = trained.length_m;
  stem.extra_curve = trained.extra_curve;
}

float pruned_length_m(const GrowingStem& stem, const WeberPennParameters& p, const Volume* volume) {
  const float ratio = volume && p.prune_ratio == 0 ? 1 : p.prune_ratio;
  if (ratio == 0) return stem.length_m;
  GrowingStem shorter = stem;
  while (!fits(shorter, p, volume)) {
    shorter.length_m *= kShorter;
    if (shorter.length_m < kShortest * stem.length_m) {
      shorter.length_m = 0;
      break;
    }
  }
  return std::lerp(stem.length_m, shorter.length_m, ratio);
}

}  // namespace espalier
