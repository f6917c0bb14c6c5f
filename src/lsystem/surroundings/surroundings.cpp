#include <algorithm>
#include <cmath>
#include <limits>

#include <espalier/core/error.h>
#include <espalier/lsystem/surroundings/light.h>
#include <espalier/lsystem/surroundings/surroundings.h>

namespace espalier::lsystem {

namespace {

constexpr double kFar = 1e5;

bool is_place(Place p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

Vec3 to_vec3(Place p) {
  const auto number = [](double x) { return static_cast<float>(std::clamp(x, -kFar, kFar)); };
  return {number(p.x), number(p.y), number(p.z)};
}

/// Constants are computed in the order of the file, and volumes between them.
template <typename Object>
const Object& there(const std::vector<Object>& objects, std::size_t index, const char* what) {
  if (index >= objects.size()) throw_input_error("got a {} before its declaration, expected it after", what);
  return objects[index];
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Surroundings::Surroundings() = default;
Surroundings::~Surroundings() = default;

double Surroundings::distance(std::size_t volume, Place place) const {
  return is_place(place) ? there(volumes, volume, "volume")->signed_distance_m(to_vec3(place)) : kNone;
}

bool Surroundings::inside(std::size_t volume, Place place) const {
  return is_place(place) && there(volumes, volume, "volume")->contains(to_vec3(place));
}

double Surroundings::field(std::size_t field, Place place) const {
  const PlacedField& placed = there(fields, field, "field");
  if (!is_place(place)) return kNone;
  const double px_per_unit = placed.picture->width_px / placed.width;
  return placed.picture->at(placed.picture->width_px / 2.0 + (place.x - placed.x) * px_per_unit,
                            placed.picture->height_px / 2.0 - (place.y - placed.y) * px_per_unit);
}

double Surroundings::light(std::size_t, Place place) const {
  if (!is_place(place)) return kNone;
  return light_ ? light_->of_sun(to_vec3(place)) : 1;
}

double Surroundings::skylight(std::size_t, Place place) const {
  if (!is_place(place)) return kNone;
  return light_ ? light_->of_sky(to_vec3(place)) : 1;
}

void Surroundings::set_light(const Plant& plant, double unit_m, Vec3 towards_sun, double gap,
                             std::span<const std::size_t> shades) {
  if (!light_) light_ = std::make_unique<PlantLight>();
  std::vector<VolumePtr> shading;
  for (const std::size_t shade : shades) shading.push_back(volumes[shade]);
  light_->set(plant, unit_m, towards_sun, gap, std::move(shading));
}

}  // namespace espalier::lsystem
