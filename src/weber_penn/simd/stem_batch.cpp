// The walk of stem_walk.cpp in vectors: every line is that of the plain walk, in the same order of roundings.
#undef HWY_TARGET_INCLUDE
// NOLINTNEXTLINE(bugprone-macro-parentheses): a name of a file
#define HWY_TARGET_INCLUDE <espalier/weber_penn/simd/stem_batch.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include <espalier/core/random_lanes-inl.h>
#include <espalier/core/vector_math-inl.h>
#include <espalier/weber_penn/simd/stem_batch.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

constexpr std::size_t kStems = StemBatch::kMostStems;

/// One number for each stem of the batch.
struct alignas(64) Numbers : std::array<float, kStems> {};

struct Numbers3 {
  Numbers x, y, z;

  void set(std::size_t i, Vec3 v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
  Vector3 load(std::size_t first) const {
    const Floats d;
    return {hn::Load(d, &x[first]), hn::Load(d, &y[first]), hn::Load(d, &z[first])};
  }
};

/// Where the stems of a batch start.
struct Start {
  alignas(64) std::array<std::uint64_t, kStems> keys;
  Numbers3 position, forward, right;
  Numbers segment_m;
};

/// The turtle of each lane [turtle.h].
struct TurtleLanes {
  Vector3 forward, right;

  void turn_left(Vector angle_deg) {
    const auto [sine, cosine] = sine_cosine_deg(hn::Neg(angle_deg));
    const Vector3 ahead = forward;
    forward = ahead * cosine + right * sine;
    right = right * cosine - ahead * sine;
  }
  void pitch_down(Vector angle_deg) {
    const auto [sine, cosine] = sine_cosine_deg(angle_deg);
    forward = forward * cosine + cross(forward, right) * sine;
  }
  static Vector3 rotated(const Vector3& v, const Vector3& axis, const SineCosine& turn) {
    return v * turn.cosine + cross(axis, v) * turn.sine +
           axis * hn::Mul(dot(axis, v), hn::Sub(set(1), turn.cosine));
  }
  /// apply_tropism [stem_walk.cpp].
  void pull(Vec3 tropism) {
    const Vector3 axis = cross(forward, {set(tropism.x), set(tropism.y), set(tropism.z)});
    const Vector strength = hn::Sqrt(dot(axis, axis));
    const auto is_pulled = hn::Gt(strength, set(1e-9f));
    const Vector3 unit = axis * hn::Div(set(1), strength);
    const SineCosine turn = sine_cosine_deg(hn::Mul(set(10), strength));
    forward = choose(is_pulled, rotated(forward, unit, turn), forward);
    right = choose(is_pulled, rotated(right, unit, turn), right);
  }
  void renormalize() {
    forward = normalized(forward, {set(0), set(0), set(1)});
    const Vector3 across = right - forward * dot(forward, right);
    const Vector norm = hn::Sqrt(dot(across, across));
    const auto has_direction = hn::Gt(norm, set(1e-12f));
    right = across * hn::Div(set(1), norm);
    if (!hn::AllTrue(Floats(), has_direction))
      right = choose(has_direction, right, any_perpendicular(forward));
  }
  static Vector3 any_perpendicular(const Vector3& a) {
    const auto is_flat = hn::Lt(hn::Abs(a.z), set(0.9f));
    const Vector3 other = choose(is_flat, {set(0), set(0), set(1)}, {set(1), set(0), set(0)});
    return normalized(cross(a, other), {set(0), set(0), set(1)});
  }
};

/// Draws of the stems for one purpose at one segment end, times `most` / segments; zeros where nothing
/// varies.
Vector jitter(const std::uint64_t* keys, Draw purpose, int at, float most, int segments) {
  if (most == 0) return set(0);
  const Vector drawn =
      signed_draws(keys, static_cast<std::uint32_t>(purpose), static_cast<std::uint32_t>(at));
  return hn::Div(hn::Mul(drawn, set(most)), set(static_cast<float>(segments)));
}

/// The part of curve_angle_deg that all stems of the level share [stem_walk.cpp].
float shared_curve_deg(int level, int at, int segments, const WeberPennParameters& p) {
  if (p.curve_back[level] == 0) return p.curve[level] / segments;
  return (2 * at <= segments ? p.curve[level] : p.curve_back[level]) * 2 / segments;
}

/// What the stems of the batch share.
struct Level {
  const WeberPennParameters& p;
  int index, segments;
  Vec3 tropism;
};

/// Turns the frames at segment end `at`.
void turn(TurtleLanes& turtle, const std::uint64_t* keys, int at, const Level& level) {
  const WeberPennParameters& p = level.p;
  const int segments = level.segments;
  const float steady_deg = steady_bend_deg(level.index, at, segments, p);
  if (p.bend_v[level.index] != 0 || steady_deg != 0)
    turtle.turn_left(hn::Add(jitter(keys, Draw::bend, at, p.bend_v[level.index], segments), set(steady_deg)));
  const Vector curve_deg = hn::Add(set(shared_curve_deg(level.index, at, segments, p)),
                                   jitter(keys, Draw::curve, at, p.curve_v[level.index], segments));
  turtle.pitch_down(hn::Mul(curve_deg, set(curve_factor(level.index, at, segments, p))));
  if (!(level.tropism == Vec3{})) turtle.pull(level.tropism);
  turtle.renormalize();
}

/// Rows of the tables of a vector of stems, an entry a vector, until they are turned round.
class Entries {
 public:
  Entries(float* tables, std::size_t stride, std::size_t count)
      : tables_(tables), stride_(stride), count_(count) {}

  /// The next entries.
  void put(const Vector3& point, const Vector3& heading, const Vector3& right) {
    std::size_t row = 0;
    for (const Vector3* v : {&point, &heading, &right})
      for (const Vector number : {v->x, v->y, v->z})
        hn::Store(number, Floats(), waiting_[row++][entry_].data());
    if (++entry_ == kMost) flush();
  }

  /// Writes whole vectors: some entries more than were put.
  void flush() {
    for (std::size_t row = 0; row < StemCurve::kRows; ++row)
      write(waiting_[row], tables_ + row * stride_ + first_);
    first_ += entry_;
    entry_ = 0;
  }

 private:
  static constexpr std::size_t kMost = 8;
  using Row = std::array<std::array<float, kMostLanes>, kMost>;

  void write(const Row& row, float* table) const {
    const std::size_t of_stem = StemCurve::kRows * stride_;
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
    alignas(64) Row turned;
    transpose(row, turned);
    for (std::size_t i = 0; i < count_; ++i)
      hn::StoreU(hn::Load(Floats(), turned[i].data()), Floats(), table + i * of_stem);
  }

  /// Pairs of rows, then of pairs, then of halves are interleaved.
  static void transpose(const Row& from, Row& to) {
    const Floats d;
    const hn::Repartition<double, Floats> pairs;
    Vector v[8], w[8];
    for (std::size_t i = 0; i < 8; ++i) v[i] = hn::Load(d, from[i].data());
    for (std::size_t i = 0; i < 8; i += 2) {
      w[i] = hn::InterleaveLower(d, v[i], v[i + 1]);
      w[i + 1] = hn::InterleaveUpper(d, v[i], v[i + 1]);
    }
    const auto as_pairs = [&](Vector a) { return hn::BitCast(pairs, a); };
    for (std::size_t i = 0; i < 8; i += 4)
      for (std::size_t half = 0; half < 2; ++half) {
        const auto a = as_pairs(w[i + half]), b = as_pairs(w[i + half + 2]);
        v[i + 2 * half] = hn::BitCast(d, hn::InterleaveLower(pairs, a, b));
        v[i + 2 * half + 1] = hn::BitCast(d, hn::InterleaveUpper(pairs, a, b));
      }
    for (std::size_t i = 0; i < 4; ++i) {
      hn::Store(hn::ConcatLowerLower(d, v[i + 4], v[i]), d, to[i].data());
      hn::Store(hn::ConcatUpperUpper(d, v[i + 4], v[i]), d, to[i + 4].data());
    }
  }

#else
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t entry = 0; entry < entry_; ++entry) table[i * of_stem + entry] = row[entry][i];
  }
#endif

  float* tables_;
  std::size_t stride_, count_, first_ = 0, entry_ = 0;
  alignas(64) std::array<Row, StemCurve::kRows> waiting_;
};

/// Stems [first, first + lanes) of the batch.
void walk_lanes(const Start& start, std::size_t first, std::size_t count, const Level& level, float* tables,
                std::size_t stride) {
  Entries entries(tables, stride, count);
  Vector3 position = start.position.load(first), heading_at_start = start.forward.load(first);
  TurtleLanes turtle{heading_at_start, start.right.load(first)};
  const Vector segment_m = hn::Load(Floats(), &start.segment_m[first]);
  for (int k = 0; k < level.segments; ++k) {
    entries.put(position, heading_at_start, turtle.right);
    heading_at_start = turtle.forward;
    position = position + turtle.forward * segment_m;
    if (k + 1 < level.segments) turn(turtle, &start.keys[first], k + 1, level);
  }
  entries.put(position, heading_at_start, turtle.right);
  entries.flush();
}

/// tables: of the first stem, then of the second, and so on.
void walk_batch(std::span<const GrowingStem> stems, int segments, const WeberPennParameters& p, float* tables,
                std::size_t stride) {
  Start start{};
  for (std::size_t i = 0; i < stems.size(); ++i) {
    start.keys[i] = stems[i].key.value;
    start.position.set(i, stems[i].turtle.position_m);
    start.forward.set(i, stems[i].turtle.forward);
    start.right.set(i, stems[i].turtle.right);
    start.segment_m[i] = stems[i].length_m / static_cast<float>(segments);
  }
  const int depth = stems[0].level;
  const Level level{
      p, level_index(depth), segments, {p.tropism_x, p.tropism_y, depth >= 2 ? p.tropism_z : 0}};
  const std::size_t lanes = hn::Lanes(Floats());
  for (std::size_t first = 0; first < stems.size(); first += lanes)
    walk_lanes(start, first, std::min(lanes, stems.size() - first), level,
               tables + first * StemCurve::kRows * stride, stride);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier {

HWY_EXPORT(walk_batch);

bool StemBatch::supports(int level, const WeberPennParameters& p) {
  const int i = level_index(level);
  return p.curve_v[i] >= 0 && p.seg_splits[i] <= 0 && !(level == 0 && p.base_splits != 0);
}

void StemBatch::walk(std::span<const GrowingStem> stems, const WeberPennParameters& p) {
  const int segments = espalier::segment_count(p, stems[0].level);
  constexpr std::size_t kReadBeyond = 16;
  const std::size_t stride = static_cast<std::size_t>(segments) + kReadBeyond,
                    stem_entries = StemCurve::kRows * stride;
  entries_.resize(stem_entries * kMostStems);
  for (std::size_t i = 0; i < stems.size(); ++i)
    curves_[i] = {segments, stems[i].length_m / static_cast<float>(segments), stride,
                  entries_.data() + i * stem_entries};
  HWY_DYNAMIC_DISPATCH(walk_batch)(stems, segments, p, entries_.data(), stride);
}

Segment StemBatch::segment(std::size_t stem, int index) const {
  const StemCurve& curve = curves_[stem];
  const float third_m = curve.segment_m / 3;
  Segment segment;
  segment.start_m = curve.point().at(index);
  segment.handle_out_m = segment.start_m + curve.heading_at_start().at(index) * third_m;
  segment.end = {curve.point().at(index + 1), curve.heading().at(index), curve.right().at(index)};
  segment.end_m = segment.end.position_m;
  segment.handle_in_m = segment.end_m - segment.end.forward * third_m;
  segment.z_start = static_cast<float>(index) / static_cast<float>(curve.segments);
  segment.z_end = static_cast<float>(index + 1) / static_cast<float>(curve.segments);
  return segment;
}

}  // namespace espalier
#endif
