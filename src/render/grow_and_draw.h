// Growing a plant and drawing its silhouettes, leaves as they grow where the renderer can: the same pixels as
// growing first and drawing then, without ever keeping the leaves.
#pragma once
#include <span>

#include <espalier/plant/model.h>
#include <espalier/render/silhouette.h>

namespace espalier {

/// Where one view of the plant goes; neither is owned.
struct SilhouetteView {
  const Camera* camera = nullptr;
  Mask* mask = nullptr;    ///< gets the camera's size
  Mask* leaves = nullptr;  ///< unless null: what leaves and blossoms cover of it
};

/// Draws a whole plant into a view.
void draw_view(SilhouetteRenderer& renderer, const Plant& plant, const SilhouetteView& view);

/// Grows into `plant`, and draws it into all views. Afterwards the plant may lack leaves, whose area, one
/// side of each, is in `leaf_area` (m²) unless that is null. Where the growth is refused, masks and area mean
/// nothing.
GrowthResult grow_and_draw(const Model& model, std::span<const double> values, Seed seed,
                           const GrowthSettings& settings, SilhouetteRenderer& renderer,
                           std::span<const SilhouetteView> views, Plant& plant, double* leaf_area = nullptr);

}  // namespace espalier
