// Colours of bark, leaves, blossoms, objects and ground. Metres; colours are linear RGB.
#include <algorithm>
#include <cmath>
#include <limits>

#include <espalier/core/random.h>
#include <espalier/render/shading/materials.h>

namespace espalier {

namespace {

constexpr float kLeafTransmission = 0.5f;  // of leaves that the model gave a colour
constexpr std::uint32_t kLeafBrightness = 1, kLeafHue = 2, kNoise = 3;

RandomKey lattice_key(int x, int y, int z) {
  const auto bits = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
  return child_key(child_key({bits(x)}, bits(y)), bits(z));
}

float smooth(float t) { return t * t * (3 - 2 * t); }

/// Value noise in [0, 1): random numbers on a unit lattice, smoothly interpolated.
float value_noise(Vec3 p) {
  const Vec3 cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y), z = static_cast<int>(cell.z);
  const float weight[3] = {smooth(p.x - cell.x), smooth(p.y - cell.y), smooth(p.z - cell.z)};
  float sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const float share =
        (i ? weight[0] : 1 - weight[0]) * (j ? weight[1] : 1 - weight[1]) * (k ? weight[2] : 1 - weight[2]);
    sum += share * uniform_unit(lattice_key(x + i, y + j, z + k), kNoise);
  }
  return sum;
}

/// Ridges along the trunk with finer cracks, in [0, 1).
float bark_noise(Vec3 point_m, float ridge_m) {
  const Vec3 p = point_m * (1 / ridge_m);
  return 0.65f * value_noise({p.x, p.y, 0.2f * p.z}) +
         0.35f * value_noise({2.7f * p.x, 2.7f * p.y, 0.8f * p.z});
}

float thickest_m(const Plant& plant) {
  float radius = 0;
  for (const float r : plant.knots.radius_m) radius = std::max(radius, r);
  return radius;
}

/// IEC 61966-2-1.
float linear(std::uint8_t srgb) {
  const float c = static_cast<float>(srgb) / 255;
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

/// The colour that the model gave to this part, if it did.
std::optional<LinearRgb> color_of(const std::vector<PartColor>& colors, std::size_t i) {
  if (i >= colors.size() || !colors[i].is_set) return std::nullopt;
  return to_linear(colors[i]);
}

}  // namespace

LinearRgb to_linear(PartColor color) { return {linear(color.r), linear(color.g), linear(color.b)}; }

SurfaceFinder::SurfaceFinder(const Plant& plant, const EmbreeScene& scene, const ShadedSettings& settings)
    : plant_(plant),
      scene_(scene),
      settings_(settings),
      size_m_(length(scene.box_m().upper - scene.box_m().lower)),
      bark_scale_m_(std::max(1e-4f, 0.22f * thickest_m(plant))) {}

Surface SurfaceFinder::stem_surface(Vec3 point, unsigned primitive) const {
  const std::uint32_t knot = scene_.stems().knot[primitive];
  if (const auto color = color_of(plant_.knots.color, knot)) return {{}, {}, *color, {0, 0, 0}};
  const float radius_m = plant_.knots.radius_m[knot];
  const float woodiness = std::clamp(radius_m / bark_scale_m_, 0.0f, 1.0f);
  const float shade = 0.55f + 0.9f * bark_noise(point, bark_scale_m_);
  return {{}, {}, lerp(settings_.twig, settings_.bark * shade, woodiness), {0, 0, 0}};
}

Surface SurfaceFinder::leaf_surface(std::uint32_t leaf, bool is_blossom) const {
  if (const auto color = color_of(plant_.leaves.color, leaf))
    return {{}, {}, *color, *color * kLeafTransmission};
  const std::uint32_t shade = leaf < plant_.leaves.shade.size() ? plant_.leaves.shade[leaf] : leaf;
  if (shade == kPlainShade && !is_blossom) return {{}, {}, settings_.leaf, settings_.leaf_through};
  const RandomKey key = child_key({0x6c656166}, shade);
  const float brightness = 1 + 0.25f * uniform_signed(key, kLeafBrightness);
  if (is_blossom) return {{}, {}, settings_.blossom * brightness, settings_.blossom * (0.4f * brightness)};
  const float yellowness = 0.25f * uniform_signed(key, kLeafHue);
  const Vec3 tint{brightness * (1 + yellowness), brightness, brightness * (1 - yellowness)};
  const auto tinted = [&](LinearRgb c) { return LinearRgb{c.x * tint.x, c.y * tint.y, c.z * tint.z}; };
  return {{}, {}, tinted(settings_.leaf), tinted(settings_.leaf_through)};
}

Surface SurfaceFinder::scene_surface(const Ray& ray, const RTCRayHit& hit) const {
  const Vec3 point = ray.origin_m + ray.direction * hit.ray.tfar;
  const Vec3 normal = normalized({hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z}, -ray.direction);
  const unsigned primitive = hit.hit.primID;
  Surface surface;
  if (hit.hit.geomID == kStemPart)
    surface = stem_surface(point, primitive);
  else if (hit.hit.geomID == kLeafPart)
    surface = leaf_surface(scene_.leaves().leaf[primitive], false);
  else if (hit.hit.geomID == kObjectPart)
    surface.reflected = settings_.object;
  else
    surface = leaf_surface(scene_.blossoms().leaf[primitive], true);
  surface.point_m = point;
  surface.normal = dot(normal, ray.direction) > 0 ? -normal : normal;
  return surface;
}

/// The plane z = 0, seen from above; opaque around the plant and gone two sizes away.
std::optional<Surface> SurfaceFinder::ground_hit(const Ray& ray) const {
  if (!settings_.ground || ray.direction.z > -1e-6f || ray.origin_m.z <= 0) return std::nullopt;
  const Vec3 point = ray.origin_m + ray.direction * (-ray.origin_m.z / ray.direction.z);
  const float distance = std::hypot(point.x, point.y) / std::max(size_m_, 1e-6f);
  const float opacity = 1 - smooth(std::clamp((distance - 0.35f) / 0.9f, 0.0f, 1.0f));
  if (opacity <= 0) return std::nullopt;
  const Vec3 p = point * (40 / std::max(size_m_, 1e-6f));
  const float shade = 0.8f + 0.4f * (0.5f * value_noise(p) + 0.5f * value_noise(p * 5.3f));
  return Surface{point, {0, 0, 1}, settings_.lawn * shade, {0, 0, 0}, opacity};
}

std::optional<Surface> SurfaceFinder::first_hit(const Ray& ray) const {
  RTCRayHit hit = embree_ray_hit(ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_.handle(), &context, &hit);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return ground_hit(ray);
  const std::optional<Surface> ground = ground_hit(ray);
  const Surface surface = scene_surface(ray, hit);
  const bool is_below_ground = ground && ground->opacity == 1 && surface.point_m.z < 0;
  return is_below_ground ? ground : surface;
}

bool SurfaceFinder::is_shadowed(const Surface& surface, Vec3 direction) const {
  const float offset_m = 1e-5f * size_m_ + 1e-5f;
  const Vec3 side = dot(surface.normal, direction) >= 0 ? surface.normal : -surface.normal;
  RTCRay ray = embree_ray_hit({surface.point_m + side * offset_m, direction}).ray;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_.handle(), &context, &ray);
  return ray.tfar < 0;
}

}  // namespace espalier
