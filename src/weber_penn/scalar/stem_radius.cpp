// The radius along a stem: cylinder, cone, rounded end and periodic swelling, and the flare of the
// trunk's foot [Weber & Penn 95, §4.4; CH, Appendix C: taper]; times the curve radius_along.
#include <cmath>

#include <espalier/weber_penn/scalar/stem.h>

namespace espalier {

namespace {

float unit_taper(float taper) {
  if (taper < 1) return taper;
  return taper < 2 ? 2 - taper : 0;
}

/// taper ≥ 1: between a cone and a rounded end, or a row of spheres where taper > 2.
float swollen_radius_m(float taper, float cone_radius_m, float to_tip_m) {
  const float depth = taper < 2 || to_tip_m < cone_radius_m ? 1 : taper - 2;
  float sphere_offset_m = to_tip_m;
  if (taper >= 2 && cone_radius_m > 0) {
    const float period_m = 2 * cone_radius_m;
    sphere_offset_m = std::fabs(to_tip_m - period_m * std::floor(to_tip_m / period_m + 0.5f));
  }
  if (taper < 2 && sphere_offset_m >= cone_radius_m) return cone_radius_m;
  const float across_m = sphere_offset_m - cone_radius_m;
  const float half_chord_m = std::sqrt(std::fmax(0.f, cone_radius_m * cone_radius_m - across_m * across_m));
  return (1 - depth) * cone_radius_m + depth * half_chord_m;
}

float flare_factor(float flare, float z) {
  const float y = std::fmax(0.f, 1 - 8 * z);
  return 1 + flare * (std::pow(100.f, y) - 1) / 100;
}

}  // namespace

float stem_radius_m(const GrowingStem& stem, float z, const WeberPennParameters& parameters) {
  const float taper = parameters.taper[level_index(stem.level)];
  float radius_m = stem.radius_m * (1 - unit_taper(taper) * z);
  if (taper >= 1) radius_m = swollen_radius_m(taper, radius_m, (1 - z) * stem.length_m);
  if (stem.level == 0) radius_m *= flare_factor(parameters.flare, z);
  const AlongCurve& along = parameters.curves.radius_along[level_index(stem.level)];
  return along.is_neutral ? radius_m : radius_m * std::fmax(0.f, along.at(z));
}

}  // namespace espalier
