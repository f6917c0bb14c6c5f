#include <algorithm>
#include <cmath>
#include <limits>

#include <espalier/core/error.h>
#include <espalier/environment/picture_envelope.h>
#include <espalier/image/masks/distance_field.h>
#include <espalier/image/reading/read_target.h>

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
        outer_distance_px_(distances_to_set_px(picture.outline)),
        right_(picture.camera.right * (1 / picture.camera.metres_per_px)),
        down_(picture.camera.up * (-1 / picture.camera.metres_per_px)),
        base_depth_m_(project(picture.camera, {0, 0, 0}).depth_m),
        limits_depth_(limits_depth) {
    for (int y = 0; y < picture.outline.height_px(); ++y) add_row(extent_of_row(picture.outline, y), y);
  }

  bool contains(Vec3 point_m) const {
    const PicturePoint seen = look_at(point_m);
    return distance_px(seen) > 0 && depth_room_m(seen) >= 0;
  }

  /// The larger of the distances across the picture and in depth: never more than the true one outside.
  float signed_distance_m(Vec3 point_m) const {
    const PicturePoint seen = look_at(point_m);
    const bool flat = camera_.projection == Projection::orthographic;
    const float across_m = picture_distance_px(seen) * camera_.metres_per_px * (flat ? 1 : seen.depth_m);
    return limits_depth_ ? std::max(across_m, -depth_room_m(seen)) : across_m;
  }

  /// Only where a pixel has one size at all depths.
  bool surely_contains_ball(Vec3 center_m, float radius_m) const {
    if (camera_.projection != Projection::orthographic) return false;
    const PicturePoint seen = look_at(center_m);
    constexpr float kPixel = 1.5f;  // the distances are those of pixel centres
    return (distance_px(seen) - kPixel) * camera_.metres_per_px > radius_m &&
           (!limits_depth_ || ball_in_depth(seen, radius_m));
  }

 private:
  /// project(camera_, point_m), without its divisions where a pixel has one size at all depths.
  PicturePoint look_at(Vec3 point_m) const {
    if (camera_.projection != Projection::orthographic) return project(camera_, point_m);
    const Vec3 offset = point_m - camera_.position_m;
    return {camera_.center_x_px + dot(offset, right_), camera_.center_y_px + dot(offset, down_),
            dot(offset, camera_.forward)};
  }

  /// Negative inside; half a pixel less than between centres, because the outline runs between them.
  float picture_distance_px(const PicturePoint& seen) const {
    if (const float inside_px = distance_px(seen); inside_px > 0) return 0.5f - inside_px;
    const float x = std::clamp(seen.x_px, 0.f, static_cast<float>(camera_.width_px) - 0.5f),
                y = std::clamp(seen.y_px, 0.f, static_cast<float>(camera_.height_px) - 0.5f);
    const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width_px) +
                              static_cast<std::size_t>(x);
    const float in_frame_px = outer_distance_px_[pixel] - 0.5f;
    if (x == seen.x_px && y == seen.y_px) return in_frame_px;
    // Beyond the frame: what is set is beyond the nearest place of the frame, and in the rectangle around it.
    return std::max(std::hypot(seen.x_px - x, seen.y_px - y, in_frame_px), distance_to_rectangle_px(seen));
  }

  void add_row(const RowExtent& extent, int y) {
    half_widths_px_.push_back(extent.half_width_px());
    if (extent.right_px < extent.left_px) return;
    left_px_ = std::min(left_px_, extent.left_px);
    right_px_ = std::max(right_px_, extent.right_px);
    top_px_ = std::min(top_px_, static_cast<float>(y));
    bottom_px_ = static_cast<float>(y + 1);
  }

  float distance_to_rectangle_px(const PicturePoint& seen) const {
    return std::hypot(std::max({0.f, left_px_ - seen.x_px, seen.x_px - right_px_}),
                      std::max({0.f, top_px_ - seen.y_px, seen.y_px - bottom_px_}));
  }

  float distance_px(const PicturePoint& seen) const {
    const bool in_frame = seen.x_px >= 0 && seen.y_px >= 0 &&
                          seen.x_px < static_cast<float>(camera_.width_px) &&
                          seen.y_px < static_cast<float>(camera_.height_px);
    if (!in_frame) return 0;
    const auto x = static_cast<int>(seen.x_px), y = static_cast<int>(seen.y_px);
    return distance_px_[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width_px) +
                        static_cast<std::size_t>(x)];
  }

  /// Metres that a pixel covers at the depth of the base.
  float metres_per_px() const {
    const bool flat = camera_.projection == Projection::orthographic;
    return camera_.metres_per_px * (flat ? 1 : base_depth_m_);
  }

  float half_depth_m(float y_px) const {
    const float row = std::clamp(std::floor(y_px), 0.f, static_cast<float>(camera_.height_px - 1));
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
  std::vector<float> distance_px_;        ///< of each pixel to the nearest unset one
  std::vector<float> outer_distance_px_;  ///< and to the nearest set one
  std::vector<float> half_widths_px_;
  static constexpr float kFar = std::numeric_limits<float>::infinity();
  float left_px_ = kFar, right_px_ = -kFar, top_px_ = kFar, bottom_px_ = -kFar;  ///< around what is set
  Vec3 right_, down_;  ///< of the picture, in pixels a metre
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

  float signed_distance_m(Vec3 point_m) const override {
    float farthest_m = -std::numeric_limits<float>::infinity();
    for (const OneOutline& one : outlines_) farthest_m = std::max(farthest_m, one.signed_distance_m(point_m));
    return farthest_m;
  }

  bool surely_contains_ball(Vec3 center_m, float radius_m) const override {
    return std::all_of(outlines_.begin(), outlines_.end(),
                       [&](const OneOutline& one) { return one.surely_contains_ball(center_m, radius_m); });
  }

  VolumeSize size() const override { return {4 * static_cast<double>(outlines_.size()), 1}; }

 private:
  std::vector<OneOutline> outlines_;
};

struct RowRange {
  int top = 0, bottom = -1;
};

RowRange rows_of(const Mask& mask) {
  RowRange rows{mask.height_px(), -1};
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      if (mask.get(x, y)) rows = {std::min(rows.top, y), y};
  return rows;
}

}  // namespace

std::unique_ptr<Volume> make_picture_volume(const std::filesystem::path& path) {
  const Mask mask = read_mask(path).mask;
  const RowRange rows = rows_of(mask);
  if (rows.bottom < 0)
    throw_input_error("{}: got an empty outline, expected a picture of a shape", path.string());
  const auto height_px = static_cast<float>(rows.bottom + 1 - rows.top);
  const Camera camera = frame_base({0, 0, 0}, {}, 1 / height_px, mask.width_px(), mask.height_px(),
                                   static_cast<float>(rows.bottom + 1));
  return make_picture_envelope({{camera, mask}});
}

std::unique_ptr<Volume> make_picture_envelope(const std::vector<PictureOutline>& outlines) {
  for (const PictureOutline& picture : outlines)
    if (area_px(picture.outline) == 0)
      throw_input_error("envelope: got an empty outline, expected a picture of a tree");
  return std::make_unique<PictureEnvelope>(outlines);
}

}  // namespace espalier
