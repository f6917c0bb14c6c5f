#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <espalier/lsystem/strings/work.h>
#include <espalier/lsystem/surroundings/light.h>

namespace espalier::lsystem {

namespace {

constexpr int kSunRays = 8, kSkyRays = 64;
constexpr float kSunRadius = 0.0524f;  // tan 3°

/// Points spread evenly over the unit disc: a spiral by the golden angle (Vogel 1979).
std::vector<std::pair<float, float>> disc_points(int count) {
  std::vector<std::pair<float, float>> points;
  for (int i = 0; i < count; ++i) {
    const double r = std::sqrt((i + 0.5) / count), angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    points.emplace_back(static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)));
  }
  return points;
}

std::vector<Vec3> sun_directions(Vec3 towards) {
  const Vec3 side = any_perpendicular(towards), up = cross(towards, side);
  std::vector<Vec3> directions;
  for (const auto& [x, y] : disc_points(kSunRays))
    directions.push_back(normalized(towards + side * (x * kSunRadius) + up * (y * kSunRadius)));
  return directions;
}

/// Lifted from the disc to the hemisphere, they are spread by the cosine (Malley's method).
std::vector<Vec3> sky_directions() {
  std::vector<Vec3> directions;
  for (const auto& [x, y] : disc_points(kSkyRays))
    directions.push_back({x, y, std::sqrt(std::max(0.f, 1 - x * x - y * y))});
  return directions;
}

/// Sphere tracing: no step is longer than the way to the surface.
bool meets(const Volume& volume, Vec3 from, Vec3 direction, float gap, double& work) {
  constexpr float kReach = 1000, kSmallStep = 0.02f;
  constexpr int kSteps = 500;
  const double parts = volume.size().parts;
  float t = gap;
  for (int i = 0; i < kSteps && t < kReach; ++i) {
    const Vec3 p = from + direction * t;
    work += 2 * work_of::kVolume * parts;
    if (volume.contains(p)) return true;
    t += std::max(0.9f * volume.signed_distance_m(p), kSmallStep);
  }
  return false;
}

}  // namespace

PlantLight::PlantLight() : sky_(sky_directions()) {}

void PlantLight::set(const Plant& plant, double unit_m, Vec3 towards_sun, double gap,
                     std::vector<VolumePtr> shades) {
  unit_m_ = static_cast<float>(unit_m);
  gap_ = static_cast<float>(gap);
  shades_ = std::move(shades);
  sun_ = sun_directions(normalized(towards_sun));
  scene_.build(plant, 0.01f * unit_m_);
}

bool PlantLight::is_free(Vec3 place, Vec3 direction, double& work) const {
  work += work_of::kRay;
  const Vec3 origin = place * unit_m_;
  RTCRay ray{origin.x,
             origin.y,
             origin.z,
             gap_ * unit_m_,
             direction.x,
             direction.y,
             direction.z,
             0,
             std::numeric_limits<float>::infinity(),
             ~0u,
             0,
             0};
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_.handle(), &context, &ray);
  if (ray.tfar < 0) return false;
  return std::none_of(shades_.begin(), shades_.end(),
                      [&](const VolumePtr& shade) { return meets(*shade, place, direction, gap_, work); });
}

LightShare PlantLight::share(const std::vector<Vec3>& directions, Vec3 place) const {
  double work = 0;
  const auto free = std::count_if(directions.begin(), directions.end(),
                                  [&](Vec3 direction) { return is_free(place, direction, work); });
  return {static_cast<double>(free) / static_cast<double>(directions.size()), work};
}

}  // namespace espalier::lsystem
