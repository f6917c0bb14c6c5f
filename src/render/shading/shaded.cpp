// The light on a surface, the samples of a pixel, and the rows of a picture. Linear RGB until the end.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <espalier/core/error.h>
#include <espalier/render/embree/embree_scene.h>
#include <espalier/render/pixel_rectangle.h>
#include <espalier/render/shading/materials.h>
#include <espalier/render/shading/samples.h>
#include <espalier/render/shading/shaded.h>

namespace espalier {

namespace {

constexpr float kRadiansPerDegree = std::numbers::pi_v<float> / 180;
constexpr LinearRgb kSunLight{3.4f, 3.1f, 2.6f};  // on a surface that faces the sun
constexpr LinearRgb kSkyZenith{0.75f, 0.95f, 1.35f}, kSkyHorizon{1.15f, 1.2f, 1.25f};
constexpr LinearRgb kLightFromBelow{0.30f, 0.30f, 0.22f};
constexpr LinearRgb kLightInTheShade{0.16f, 0.20f, 0.12f};  // stands for light that bounces

enum Purpose : std::uint32_t { kPixelPurpose, kSunPurpose, kSkyPurpose };

LinearRgb product(LinearRgb a, LinearRgb b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

struct Shader {
  const SurfaceFinder& surfaces;
  const ShadedSettings& settings;
  Vec3 sun;  ///< unit vector towards it

  LinearRgb sky(Vec3 direction) const {
    return direction.z > 0 ? lerp(kSkyHorizon, kSkyZenith, direction.z) : kLightFromBelow;
  }

  LinearRgb light_from_sun(const Surface& surface, UnitSquarePoint p) const {
    const float half_angle_tangent = std::tan(0.5f * settings.sun_diameter_deg * kRadiansPerDegree);
    const Vec3 direction = cone_direction(sun, half_angle_tangent, p);
    const float cosine = dot(surface.normal, direction);
    const LinearRgb share = cosine > 0 ? surface.reflected : surface.transmitted;
    if (share == LinearRgb{0, 0, 0} || surfaces.is_shadowed(surface, direction)) return {0, 0, 0};
    return product(share, kSunLight) * std::fabs(cosine);
  }

  LinearRgb light_from_sky(const Surface& surface, UnitSquarePoint p) const {
    const Vec3 direction = cosine_direction(surface.normal, p);
    const LinearRgb incoming = surfaces.is_shadowed(surface, direction) ? kLightInTheShade : sky(direction);
    return product(surface.reflected, incoming);
  }
};

/// The filmic curve of Narkowicz (2015), "ACES filmic tone mapping curve".
float tone_mapped(float x) {
  return std::clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f);
}

LinearRgb tone_mapped(LinearRgb c) { return {tone_mapped(c.x), tone_mapped(c.y), tone_mapped(c.z)}; }

/// IEC 61966-2-1.
std::uint8_t srgb_byte(float linear) {
  const float encoded = linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(encoded, 0.0f, 1.0f)));
}

/// One colour a row: what a pixel shows does not depend on whether its samples were traced.
LinearRgb background(const ShadedSettings& settings, const Camera& camera, int y) {
  return lerp(settings.background_top, settings.background_bottom,
              (static_cast<float>(y) + 0.5f) / static_cast<float>(camera.height_px));
}

/// What one sample of a pixel sees before the background: a colour on screen (tone-mapped, linear), and how
/// opaque.
struct Sample {
  LinearRgb color;
  float opacity = 0;
};

Sample take_sample(const Shader& shader, const Camera& camera, float x_px, float y_px, RandomKey pixel,
                   int sample) {
  const std::optional<Surface> surface = shader.surfaces.first_hit(camera_ray(camera, x_px, y_px));
  if (!surface) return {};
  const LinearRgb light = shader.light_from_sun(*surface, sample_point(pixel, kSunPurpose, sample)) +
                          shader.light_from_sky(*surface, sample_point(pixel, kSkyPurpose, sample));
  return {tone_mapped(light), surface->opacity};
}

/// use(sample) for each of a pixel, in their order.
template <typename Use>
void for_each_sample(const Shader& shader, const Camera& camera, int x, int y, Use use) {
  const RandomKey pixel =
      child_key(child_key({0x706978656c}, static_cast<std::uint64_t>(x)), static_cast<std::uint64_t>(y));
  for (int i = 0; i < shader.settings.samples_per_px; ++i) {
    const UnitSquarePoint p = sample_point(pixel, kPixelPurpose, i);
    use(take_sample(shader, camera, static_cast<float>(x) + p.u, static_cast<float>(y) + p.v, pixel, i));
  }
}

Rgb to_srgb(LinearRgb color) { return {srgb_byte(color.x), srgb_byte(color.y), srgb_byte(color.z)}; }

Rgb pixel_color(const Shader& shader, const Camera& camera, int x, int y) {
  const LinearRgb behind = background(shader.settings, camera, y);
  LinearRgb sum;
  for_each_sample(shader, camera, x, y, [&](const Sample& sample) {
    sum += sample.opacity == 0 ? behind : lerp(behind, sample.color, sample.opacity);
  });
  return to_srgb(sum * (1 / static_cast<float>(shader.settings.samples_per_px)));
}

/// The mean colour of what covers the pixel, and how much of it.
Rgb cut_out_pixel(const Shader& shader, const Camera& camera, int x, int y, std::uint8_t& cover) {
  LinearRgb sum;
  float opacity = 0;
  for_each_sample(shader, camera, x, y, [&](const Sample& sample) {
    sum += sample.color * sample.opacity;
    opacity += sample.opacity;
  });
  cover = static_cast<std::uint8_t>(
      std::lround(255 * opacity / static_cast<float>(shader.settings.samples_per_px)));
  return opacity > 0 ? to_srgb(sum * (1 / opacity)) : Rgb{};
}

Rgb background_color(const ShadedSettings& settings, const Camera& camera, int y) {
  return to_srgb(background(settings, camera, y));
}

/// The direction moves with the viewer, so that the side that is seen is lit whatever the view.
Vec3 sun_direction(const Camera& camera, const ShadedSettings& settings) {
  const Vec3 towards_viewer = normalized({-camera.forward.x, -camera.forward.y, 0}, {0, -1, 0});
  const Vec3 to_the_right = cross({0, 0, 1}, towards_viewer);
  const float azimuth = settings.sun_azimuth_deg * kRadiansPerDegree;
  const float elevation = settings.sun_elevation_deg * kRadiansPerDegree;
  return (towards_viewer * std::cos(azimuth) + to_the_right * std::sin(azimuth)) * std::cos(elevation) +
         Vec3{0, 0, std::sin(elevation)};
}

/// The box around everything that is drawn: the ground reaches further than the plant.
Bounds drawn_box(Bounds box, const ShadedSettings& settings) {
  if (!settings.ground) return box;
  const float reach_m = 1.5f * length(box.upper - box.lower);
  return {box.lower - Vec3{reach_m, reach_m, 0}, box.upper + Vec3{reach_m, reach_m, 0}};
}

bool contains(const PixelRectangle& rectangle, int x, int y) {
  return x >= rectangle.begin_x && x < rectangle.end_x && y >= rectangle.begin_y && y < rectangle.end_y;
}

/// What rays meet of a plant: built anew only for a camera that needs finer or coarser stems.
class ShadedScene {
 public:
  ShadedScene(const Plant& plant, const SceneObjects& objects) : plant_(plant), objects_(objects) {}

  const EmbreeScene& for_camera(const Camera& camera) {
    const float tolerance_m = stem_tolerance_m(plant_, camera);
    if (tolerance_m != built_for_m_) scene_.build(plant_, tolerance_m, objects_);
    built_for_m_ = tolerance_m;
    return scene_;
  }

 private:
  const Plant& plant_;
  const SceneObjects& objects_;
  EmbreeScene scene_{SceneQuality::fast_trace};
  float built_for_m_ = 0;  ///< tolerance
};

/// draw(shader, camera, x, y, may_be_covered) for each pixel; rows run in parallel.
template <typename Draw>
void for_each_pixel(const Plant& plant, const EmbreeScene& scene, const Camera& camera,
                    const ShadedSettings& settings, Draw draw) {
  ESPALIER_CHECK_EQ(settings.samples_per_px >= 1 && settings.samples_per_px <= 1024, true);
  const SurfaceFinder surfaces(plant, scene, settings);
  const Camera traced = moved_before(camera, drawn_box(scene.box_m(), settings));
  const Shader shader{surfaces, settings, sun_direction(camera, settings)};
  const PixelRectangle covered = covered_pixels(camera, scene.box_m());
#pragma omp parallel for schedule(dynamic, 1)
  for (int y = 0; y < camera.height_px; ++y)
    for (int x = 0; x < camera.width_px; ++x)
      draw(shader, traced, x, y, settings.ground || contains(covered, x, y));
}

}  // namespace

std::vector<Picture> render_shaded(const Plant& plant, std::span<const Camera> cameras,
                                   const ShadedSettings& settings, const SceneObjects& objects) {
  ShadedScene scene(plant, objects);
  std::vector<Picture> pictures;
  for (const Camera& camera : cameras) {
    Picture& picture = pictures.emplace_back(camera.width_px, camera.height_px);
    for_each_pixel(plant, scene.for_camera(camera), camera, settings,
                   [&](const Shader& shader, const Camera& traced, int x, int y, bool may_be_covered) {
                     picture.at(x, y) = may_be_covered ? pixel_color(shader, traced, x, y)
                                                       : background_color(settings, camera, y);
                   });
  }
  return pictures;
}

Picture render_shaded(const Plant& plant, const Camera& camera, const ShadedSettings& settings,
                      const SceneObjects& objects) {
  return std::move(render_shaded(plant, std::span(&camera, 1), settings, objects).front());
}

CutOut render_cut_out(const Plant& plant, const Camera& camera, const ShadedSettings& settings,
                      const SceneObjects& objects) {
  ShadedScene scene(plant, objects);
  CutOut cut{Picture(camera.width_px, camera.height_px), {}};
  cut.cover.resize(cut.picture.pixels.size());
  for_each_pixel(plant, scene.for_camera(camera), camera, settings,
                 [&](const Shader& shader, const Camera& traced, int x, int y, bool may_be_covered) {
                   if (!may_be_covered) return;
                   const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width_px) +
                                   static_cast<std::size_t>(x);
                   cut.picture.pixels[at] = cut_out_pixel(shader, traced, x, y, cut.cover[at]);
                 });
  return cut;
}

}  // namespace espalier
