#include <algorithm>
#include <cmath>
#include <limits>

#include <espalier/core/error.h>
#include <espalier/lsystem/strings/work.h>
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

void Surroundings::count(double units) const {
  if (work_) work_->add(units);
}

const Volume& Surroundings::asked_volume(std::size_t volume) const {
  const Volume& asked = *there(volumes, volume, "volume");
  count(work_of::kVolume * asked.size().parts);
  return asked;
}

double Surroundings::distance(std::size_t volume, Place place) const {
  return is_place(place) ? asked_volume(volume).signed_distance_m(to_vec3(place)) : kNone;
}

bool Surroundings::inside(std::size_t volume, Place place) const {
  return is_place(place) && asked_volume(volume).contains(to_vec3(place));
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
  if (!light_) return 1;
  const LightShare sun = light_->of_sun(to_vec3(place));
  count(sun.work);
  return sun.free;
}

double Surroundings::skylight(std::size_t, Place place) const {
  if (!is_place(place)) return kNone;
  if (!light_) return 1;
  const LightShare sky = light_->of_sky(to_vec3(place));
  count(sky.work);
  return sky.free;
}

void Surroundings::set_light(const Plant& plant, double unit_m, Vec3 towards_sun, double gap,
                             std::span<const std::size_t> shades) {
  if (!light_) light_ = std::make_unique<PlantLight>();
  std::vector<VolumePtr> shading;
  for (const std::size_t shade : shades) shading.push_back(volumes[shade]);
  light_->set(plant, unit_m, towards_sun, gap, std::move(shading));
}

}  // namespace espalier::lsystem
