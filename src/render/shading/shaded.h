// Shaded pictures of plants: sun with soft shadows, sky light with ambient occlusion, bark, leaves that let
// light through, blossoms, what stands beside the plant, optional ground. Direct light only: what the sky
// cannot reach gets a constant. Colours are linear RGB (a Vec3 of red, green, blue; 1 is white); pictures are
// sRGB.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/core/vec3.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/plant/plant.h>
#include <espalier/render/camera.h>
#include <espalier/render/scene_objects.h>

namespace espalier {

using LinearRgb = Vec3;

struct ShadedSettings {
  int samples_per_px = 16;        ///< 1..1024 rays a pixel, each with one ray to the sun and one to the sky
  bool ground = false;            ///< a lawn at z = 0 that fades into the background
  float sun_azimuth_deg = -50;    ///< relative to the viewer: negative is to the left
  float sun_elevation_deg = 42;   ///< above the horizon
  float sun_diameter_deg = 2.5f;  ///< larger than the real one: softer shadows
  LinearRgb bark{0.17f, 0.135f, 0.10f}, twig{0.15f, 0.10f, 0.065f};
  LinearRgb leaf{0.075f, 0.15f, 0.035f}, leaf_through{0.10f, 0.19f, 0.025f};
  LinearRgb blossom{0.80f, 0.55f, 0.62f};
  LinearRgb lawn{0.13f, 0.17f, 0.06f};
  LinearRgb object{0.42f, 0.33f, 0.25f};  ///< of houses and walls
  LinearRgb background_top{0.72f, 0.84f, 0.97f}, background_bottom{1, 1, 1};
};

/// Renders `plant` as `camera` sees it, with what stands beside it. Rows run in parallel; the same bits for
/// any number of threads.
Picture render_shaded(const Plant& plant, const Camera& camera, const ShadedSettings& settings = {},
                      const SceneObjects& objects = {});

/// The same from several sides: what rays meet is built once for cameras of one scale.
std::vector<Picture> render_shaded(const Plant& plant, std::span<const Camera> cameras,
                                   const ShadedSettings& settings = {}, const SceneObjects& objects = {});

struct CutOut {
  Picture picture;                  ///< the colours of what is drawn alone, without a background
  std::vector<std::uint8_t> cover;  ///< its opacity, 0 … 255 a pixel
};

/// The same before nothing: what lets the background through is transparent.
CutOut render_cut_out(const Plant& plant, const Camera& camera, const ShadedSettings& settings = {},
                      const SceneObjects& objects = {});

}  // namespace espalier
