// The fast renderer of silhouettes, for searches.
#pragma once
#include <memory>

#include <espalier/render/silhouette.h>

namespace espalier {

/// Draws by scan lines the pixels that the reference sets (render/embree/embree_renderer.h), but for a few on
/// edges (docs/fast_path.md).
std::unique_ptr<SilhouetteRenderer> make_scanline_renderer();

}  // namespace espalier
