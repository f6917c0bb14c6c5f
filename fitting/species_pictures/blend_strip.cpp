#include <algorithm>
#include <cmath>

#include <espalier/core/parallel_for.h>
#include <espalier/fitting/species_pictures/blend_strip.h>
#include <espalier/fitting/species_pictures/plant_pictures.h>
#include <espalier/image/reading/frame.h>
#include <espalier/render/scanlines/scanline_renderer.h>
#include <espalier/render/silhouette.h>

namespace espalier {

namespace {

/// One that holds all of the seeds' trees.
double largest_frame_m(const Model& model, const ParameterValues& values, int seeds) {
  double frame = 1e-3;
  Plant plant;
  for (int seed = 1; seed <= seeds; ++seed)
    if (model.generate(values, static_cast<Seed>(seed), {}, plant).grown)
      frame = std::max(frame, frame_m(plant));
  return frame;
}

Mask silhouette(const Model& model, const ParameterValues& values, Seed seed, double frame, int size_px) {
  thread_local Plant plant;
  thread_local const std::unique_ptr<SilhouetteRenderer> renderer = make_scanline_renderer();
  Mask mask(size_px, size_px);
  plant.clear();
  if (!model.generate(values, seed, {}, plant).grown) return mask;
  const auto metres_per_px = static_cast<float>(frame / size_px);
  renderer->draw(plant, frame_base({0, 0, 0}, {}, metres_per_px, size_px, size_px, base_row_px(size_px)),
                 mask);
  return mask;
}

}  // namespace

std::vector<ParameterValues> blend_strip(const Model& model, const Encoding& encoding,
                                         const ParameterValues& a, const ParameterValues& b, int steps) {
  std::vector<ParameterValues> strip;
  for (int i = 0; i <= steps; ++i)
    strip.push_back(blend(model, encoding, a, b, static_cast<double>(i) / steps));
  return strip;
}

std::vector<double> silhouette_changes(const Model& model, const std::vector<ParameterValues>& strip,
                                       const StripView& view) {
  const double first = largest_frame_m(model, strip.front(), view.seeds);
  const double last = largest_frame_m(model, strip.back(), view.seeds);
  const auto stride = static_cast<std::size_t>(view.seeds);
  std::vector<Mask> masks(strip.size() * stride);
  parallel_for(masks.size(), [&](std::size_t i) {
    const std::size_t step = i / stride;
    const double t = static_cast<double>(step) / static_cast<double>(strip.size() - 1);
    masks[i] = silhouette(model, strip[step], static_cast<Seed>(i % stride + 1),
                          first * std::pow(last / first, t), view.size_px);
  });
  std::vector<double> changes(strip.size() - 1, 0);
  for (std::size_t i = 0; i + stride < masks.size(); ++i)
    changes[i / stride] += static_cast<double>(differing_px(masks[i], masks[i + stride])) /
                           (static_cast<double>(view.size_px) * view.size_px * view.seeds);
  return changes;
}

StripEvenness strip_evenness(const std::vector<double>& changes) {
  std::vector<double> sorted = changes;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t middle = sorted.size() / 2;
  const double median = sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
  const auto largest = std::max_element(changes.begin(), changes.end());
  return {median, *largest, static_cast<int>(largest - changes.begin())};
}

}  // namespace espalier
