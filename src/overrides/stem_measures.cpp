#include <algorithm>

#include <espalier/overrides/stem_measures.h>

namespace espalier {

namespace {

constexpr int kChords = 8;  ///< of a segment, whose lengths add up to its length

/// The Bézier segment from knot k to the next.
Vec3 point_of(const Knots& knots, std::size_t k, float t) {
  const float s = 1 - t;
  return knots.point_m[k] * (s * s * s) + knots.handle_out_m[k] * (3 * s * s * t) +
         knots.handle_in_m[k + 1] * (3 * s * t * t) + knots.point_m[k + 1] * (t * t * t);
}

float length_of(const Knots& knots, std::size_t k) {
  float sum = 0;
  Vec3 last = knots.point_m[k];
  for (int i = 1; i <= kChords; ++i) {
    const Vec3 next = point_of(knots, k, static_cast<float>(i) / kChords);
    sum += length(next - last);
    last = next;
  }
  return sum;
}

Vec3 direction_of(const Knots& knots, std::size_t k, float t) {
  const Vec3 p0 = knots.point_m[k], p1 = knots.handle_out_m[k], p2 = knots.handle_in_m[k + 1],
             p3 = knots.point_m[k + 1];
  const float s = 1 - t;
  const Vec3 along = (p1 - p0) * (s * s) + (p2 - p1) * (2 * s * t) + (p3 - p2) * (t * t);
  return normalized(along, normalized(p3 - p0));
}

std::size_t knot_count(const Stems& stems, std::size_t stem) {
  return stems.first_knot[stem + 1] - stems.first_knot[stem];
}

}  // namespace

Vec3 point_at(const Stems& stems, const Knots& knots, std::size_t stem, StemPlace place) {
  const std::size_t k = stems.first_knot[stem] + place.knot;
  if (knot_count(stems, stem) == 0) return {};
  return place.t == 0 ? knots.point_m[k] : point_of(knots, k, place.t);
}

Vec3 direction_at(const Stems& stems, const Knots& knots, std::size_t stem, StemPlace place) {
  const std::size_t count = knot_count(stems, stem), k = stems.first_knot[stem] + place.knot;
  if (count < 2) return {0, 0, 1};
  return place.knot + 1 < count ? direction_of(knots, k, place.t) : direction_of(knots, k - 1, 1);
}

ArcLengths::ArcLengths(const Plant& plant) : at_knot_m_(plant.knots.size()) {
  for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
    float sum = 0;
    for (std::size_t k = plant.stems.first_knot[stem]; k < plant.stems.first_knot[stem + 1]; ++k) {
      at_knot_m_[k] = sum;
      if (k + 1 < plant.stems.first_knot[stem + 1]) sum += length_of(plant.knots, k);
    }
  }
}

float ArcLengths::of_stem_m(const Stems& stems, std::size_t stem) const {
  return knot_count(stems, stem) == 0 ? 0 : at_knot_m_[stems.first_knot[stem + 1] - 1];
}

float ArcLengths::fraction_at(const Stems& stems, std::size_t stem, StemPlace place) const {
  const float whole_m = of_stem_m(stems, stem);
  if (!(whole_m > 0)) return 0;
  const std::size_t k = stems.first_knot[stem] + place.knot;
  const float next_m = place.knot + 1 < knot_count(stems, stem) ? at_knot_m_[k + 1] : at_knot_m_[k];
  return (at_knot_m_[k] + place.t * (next_m - at_knot_m_[k])) / whole_m;
}

StemPlace ArcLengths::place_at(const Stems& stems, std::size_t stem, float fraction) const {
  const auto first = at_knot_m_.begin() + stems.first_knot[stem],
             end = at_knot_m_.begin() + stems.first_knot[stem + 1];
  if (end - first < 2) return {};
  const float wanted_m = fraction * of_stem_m(stems, stem);
  const auto after = std::upper_bound(first, end, wanted_m);
  const auto knot = std::max(after, first + 1) - 1;
  if (knot + 1 == end) return {static_cast<std::uint32_t>(knot - first), 0};
  const float segment_m = *(knot + 1) - *knot;
  return {static_cast<std::uint32_t>(knot - first), segment_m > 0 ? (wanted_m - *knot) / segment_m : 0};
}

}  // namespace espalier
