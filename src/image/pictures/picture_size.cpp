#include <algorithm>

#include <espalier/core/error.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/image/pictures/picture_size.h>

namespace espalier {

void check_picture_size(const std::filesystem::path& path, std::uintmax_t bytes, double width_px,
                        double height_px, int layers) {
  const double pixels = width_px * height_px * std::max(1, layers);
  if (pixels > static_cast<double>(kMaxSourcePixels) || layers > 1)
    throw_input_error("{}: claims {}×{}×{} pixels, expected at most {} in one layer", path.string(), width_px,
                      height_px, layers, kMaxSourcePixels);
  if (std::min(width_px, height_px) < kMinSourceSide)
    throw_input_error("{}: has {}×{} pixels, expected at least {} on each side", path.string(), width_px,
                      height_px, kMinSourceSide);
  if (pixels > kMaxPixelsPerByte * static_cast<double>(bytes))
    throw_input_error("{}: claims {}×{} pixels in {} bytes: is cut off, or shows no tree", path.string(),
                      width_px, height_px, bytes);
}

}  // namespace espalier
