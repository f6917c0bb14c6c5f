// Knots of many stems, see curve_knots.h. A knot's handles are a third of a segment away on both sides.
#undef HWY_TARGET_INCLUDE
// NOLINTNEXTLINE(bugprone-macro-parentheses): a name of a file
#define HWY_TARGET_INCLUDE <espalier/weber_penn/simd/curve_knots.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <espalier/weber_penn/scalar/stem_radius-inl.h>
#include <espalier/weber_penn/simd/curve_knots.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

Vector3 load(const StemCurve::Rows3& rows, int at) {
  const Floats d;
  return {hn::LoadU(d, rows.x + at), hn::LoadU(d, rows.y + at), hn::LoadU(d, rows.z + at)};
}

void store(const Vector3& v, Vec3* to) { hn::StoreInterleaved3(v.x, v.y, v.z, Floats(), &to->x); }

/// Writes whole vectors from `knot` on: up to 7 knots more than the stem has.
void put_knots(const GrowingStem& stem, const StemCurve& curve, const WeberPennParameters& p,
               std::size_t knot, Knots& knots) {
  const Vector third_m = set(curve.segment_m / 3), segments = set(static_cast<float>(curve.segments));
  for (int at = 0; at <= curve.segments; at += static_cast<int>(hn::Lanes(Floats()))) {
    const std::size_t to = knot + static_cast<std::size_t>(at);
    const Vector3 point = load(curve.point(), at), handle = load(curve.heading_at_start(), at) * third_m;
    store(point, &knots.point_m[to]);
    store(point - handle, &knots.handle_in_m[to]);
    store(point + handle, &knots.handle_out_m[to]);
    const Vector z = hn::Div(hn::ConvertTo(Floats(), counted_from(at)), segments);
    hn::StoreU(radius_at(stem, z, p), Floats(), &knots.radius_m[to]);
  }
}

void put_all_knots(std::span<const GrowingStem> stems, const StemBatch& batch, const WeberPennParameters& p,
                   std::size_t knot, Knots& knots) {
  for (std::size_t i = 0; i < stems.size(); ++i) {
    put_knots(stems[i], batch.curve(i), p, knot, knots);
    knot += static_cast<std::size_t>(batch.segment_count()) + 1;
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier {

HWY_EXPORT(put_all_knots);

bool has_plain_knots(int level, const WeberPennParameters& p) {
  return level > 0 && p.taper[level_index(level)] <= 1;
}

void append_knots(std::span<const GrowingStem> stems, const StemBatch& batch, const WeberPennParameters& p,
                  Plant& plant) {
  constexpr std::size_t kWrittenBeyond = 8;
  Knots& knots = plant.knots;
  const std::size_t before = knots.size(), of_each = static_cast<std::size_t>(batch.segment_count()) + 1,
                    after = before + stems.size() * of_each;
  const auto resize = [&](std::size_t size) {
    for (auto* column : {&knots.point_m, &knots.handle_in_m, &knots.handle_out_m}) column->resize(size);
    knots.radius_m.resize(size);
  };
  resize(after + kWrittenBeyond);
  HWY_DYNAMIC_DISPATCH(put_all_knots)(stems, batch, p, before, knots);
  resize(after);
  for (std::size_t i = 1; i <= stems.size(); ++i)
    plant.stems.first_knot.push_back(static_cast<std::uint32_t>(before + i * of_each));
}

}  // namespace espalier
#endif
