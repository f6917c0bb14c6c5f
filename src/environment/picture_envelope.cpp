#include "environment/picture_envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "image/distance_field.h"

namespace espalier {

namespace {

/// The columns between which a row of the outline is set, or none.
struct RowExtent {
  float left_px = 0, right_px = -1;
  float half_width_px() const { return std::max(0.f, (right_px - left_px) / 2); }
};

RowExtent extent_of_row(const Mask& mask, int y) {
  RowExtent extent;
  for (int x = 0; x < mask.width_px(); ++x) {
    if (!mask.get(x, y)) continue;
    if (extent.right_px < extent.left_px) extent.left_px = static_cast<float>(x);
    extent.right_px = static_cast<float>(x + 1);
  }
  return extent;
}

/// One picture's side of the volume.
class OneOutline {
 public:
  OneOutline(const PictureOutline& picture, bool limits_depth)
      : camera_(picture.camera),
        distance_px_(distances_to_unset_px(picture.outline)),
        base_depth_m_(project(picture.camera, {0, 0, 0}).depth_m),
        limits_depth_(limits_depth) {
    for (int y = 0; y < picture.outline.height_px(); ++y)
      half_widths_px_.push_back(extent_of_row(picture.outline, y).half_width_px());
  }

  bool contains(Vec3 point_m) const {
    const PicturePoint seen = project(camera_, point_m);
    return distance_px(seen) > 0 && depth_room_m(seen) >= 0;
  }

  /// Only where a pixel has one size at all depths.
  bool surely_contains_ball(Vec3 center_m, float radius_m) const {
    if (camera_.projection != Projection::orthographic) return false;
    const PicturePoint seen = project(camera_, center_m);
    constexpr float kPixel = 1.5f;  // the distances are those of pixel centres
    return (distance_px(seen) - kPixel) * camera_.metres_per_px > radius_m &&
           (!limits_depth_ || ball_in_depth(seen, radius_m));
  }

 private:
  float distance_px(const PicturePoint& seen) const {
    const auto x = static_cast<int>(std::floor(seen.x_px)), y = static_cast<int>(std::floor(seen.y_px));
    if (x < 0 || y < 0 || x >= camera_.width_px || y >= camera_.height_px) return 0;
    return distance_px_[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width_px) +
                        static_cast<std::size_t>(x)];
  }

  /// Metres that a pixel covers at the depth of the base.
  float metres_per_px() const {
    const bool flat = camera_.projection == Projection::orthographic;
    return camera_.metres_per_px * (flat ? 1 : base_depth_m_);
  }

  float half_depth_m(float y_px) const {
    const int row = std::clamp(static_cast<int>(std::floor(y_px)), 0, camera_.height_px - 1);
    return half_widths_px_[static_cast<std::size_t>(row)] * metres_per_px();
  }

  float depth_room_m(const PicturePoint& seen) const {
    if (!limits_depth_) return 0;
    return half_depth_m(seen.y_px) - std::fabs(seen.depth_m - base_depth_m_);
  }

  bool ball_in_depth(const PicturePoint& seen, float radius_m) const {
    const float radius_px = radius_m / camera_.metres_per_px,
                reach_m = std::fabs(seen.depth_m - base_depth_m_);
    for (float y = seen.y_px - radius_px; y <= seen.y_px + radius_px + 1; y += 1)
      if (half_depth_m(y) < reach_m + radius_m) return false;
    return true;
  }

  Camera camera_;
  std::vector<float> distance_px_;  ///< of each pixel to the nearest unset one
  std::vector<float> half_widths_px_;
  float base_depth_m_;
  bool limits_depth_;
};

class PictureEnvelope : public Volume {
 public:
  explicit PictureEnvelope(const std::vector<PictureOutline>& pictures) {
    for (const PictureOutline& picture : pictures) outlines_.emplace_back(picture, pictures.size() == 1);
  }

  bool contains(Vec3 point_m) const override {
    return std::all_of(outlines_.begin(), outlines_.end(),
                       [&](const OneOutline& one) { return one.contains(point_m); });
  }

  bool surely_contains_ball(Vec3 center_m, float radius_m) const override {
    return std::all_of(outlines_.begin(), outlines_.end(),
                       [&](const OneOutline& one) { return one.surely_contains_ball(center_m, radius_m); });
  }

 private:
  std::vector<OneOutline> outlines_;
};

}  // namespace

std::unique_ptr<Volume> make_picture_envelope(std::vector<PictureOutline> outlines) {
  for (const PictureOutline& picture : outlines)
    if (area_px(picture.outline) == 0)
      throw_input_error("envelope: got an empty outline, expected a picture of a tree");
  return std::make_unique<PictureEnvelope>(outlines);
}

}  // namespace espalier
