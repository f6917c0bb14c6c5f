#include <algorithm>

#include <espalier/plant/leaf_outlines.h>
#include <espalier/render/grow_and_draw.h>

namespace espalier {

namespace {

/// Draws leaves into all pictures as they come.
class LeafPen : public LeafSink {
 public:
  LeafPen(SilhouetteParts& parts, std::span<const SilhouetteView> views, double* area)
      : parts_(parts), views_(views), area_(area) {}

  void take(const LeafColumns& leaves) override {
    if (area_)
      *area_ += leaf_area_m2({leaves.length_m, leaves.count}, {leaves.width_m, leaves.count}, leaves.shape);
    for (const SilhouetteView& view : views_) parts_.add_leaves(leaves, *view.camera, *view.mask);
  }

 private:
  SilhouetteParts& parts_;
  std::span<const SilhouetteView> views_;
  double* area_;
};

/// Of the leaves that the plant did not hand over.
void add_kept_leaves(const Plant& plant, double* leaf_area) {
  if (leaf_area) *leaf_area += leaf_area_m2(plant.leaves.length_m, plant.leaves.width_m, plant.leaf_shape);
}

}  // namespace

void draw_view(SilhouetteRenderer& renderer, const Plant& plant, const SilhouetteView& view) {
  if (view.leaves)
    renderer.draw_apart(plant, *view.camera, *view.mask, *view.leaves);
  else
    renderer.draw(plant, *view.camera, *view.mask);
}

GrowthResult grow_and_draw(const Model& model, std::span<const double> values, Seed seed,
                           const GrowthSettings& settings, SilhouetteRenderer& renderer,
                           std::span<const SilhouetteView> views, Plant& plant, double* leaf_area) {
  if (leaf_area) *leaf_area = 0;
  SilhouetteParts* const parts = renderer.parts();
  const bool in_parts =
      parts != nullptr && std::all_of(views.begin(), views.end(), [](const SilhouetteView& view) {
        return view.camera->projection == Projection::orthographic;
      });
  if (!in_parts) {
    const GrowthResult result = model.generate(values, seed, settings, plant);
    if (result.grown)
      for (const SilhouetteView& view : views) draw_view(renderer, plant, view);
    add_kept_leaves(plant, leaf_area);
    return result;
  }
  for (const SilhouetteView& view : views) view.mask->reset(view.camera->width_px, view.camera->height_px);
  LeafPen pen(*parts, views, leaf_area);
  GrowthSettings with_pen = settings;
  with_pen.leaf_sink = &pen;
  const GrowthResult result = model.generate(values, seed, with_pen, plant);
  if (result.grown)
    for (const SilhouetteView& view : views) parts->add_plant(plant, *view.camera, *view.mask, view.leaves);
  add_kept_leaves(plant, leaf_area);
  return result;
}

}  // namespace espalier
