// The reference renderer of silhouettes: traces rays.
#pragma once
#include <memory>

#include <espalier/render/silhouette.h>

namespace espalier {

/// Traces rays with Embree 3. Stems are cones along the curves, fine enough for the largest picture; leaves
/// are their polygons (render/embree/embree_geometry.h).
std::unique_ptr<SilhouetteRenderer> make_embree_renderer();

}  // namespace espalier
