#include <algorithm>
#include <optional>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/image/masks/mask_box.h>
#include <espalier/image/reading/frame.h>
#include <espalier/image/reading/read_target.h>
#include <espalier/image/reading/roots.h>

namespace espalier {

namespace {

/// The middle of the trunk above its roots, or the mean x of the set pixels in the lowest 2 % of the tree's
/// rows.
double find_foot_x(const Mask& mask, const MaskBox& box) {
  if (const std::optional<Roots> roots = roots_of(mask, box))
    return static_cast<double>(roots->trunk.middle());
  const int foot_rows = std::max(1, box.rows(0.02));
  double sum = 0, count = 0;
  for (int y = box.bottom - foot_rows; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x)
      if (mask.get(x, y)) {
        sum += x + 0.5;
        count += 1;
      }
  return sum / count;
}

/// Sums of set pixels over boxes with any corners, in constant time (Crow, Summed-area tables, 1984).
class AreaTable {
 public:
  explicit AreaTable(const Mask& mask)
      : width_(mask.width_px()),
        height_(mask.height_px()),
        sums_(static_cast<std::size_t>(width_ + 1) * (height_ + 1), 0) {
    for (int y = 0; y < height_; ++y) {
      std::uint32_t row_sum = 0;
      for (int x = 0; x < width_; ++x) {
        row_sum += mask.get(x, y);
        sums_[index(x + 1, y + 1)] = sums_[index(x + 1, y)] + row_sum;
      }
    }
  }

  /// Set area of the box; outside the mask nothing is set.
  double area(double left, double top, double right, double bottom) const {
    return corner(right, bottom) - corner(left, bottom) - corner(right, top) + corner(left, top);
  }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * (width_ + 1) + x; }

  /// Set area left of and above (x, y). Linear between whole pixels, as each pixel is of one value.
  double corner(double x, double y) const {
    x = std::clamp(x, 0.0, static_cast<double>(width_));
    y = std::clamp(y, 0.0, static_cast<double>(height_));
    const int i = std::min(static_cast<int>(x), width_ - 1), j = std::min(static_cast<int>(y), height_ - 1);
    const double u = x - i, v = y - j;
    return (1 - v) * ((1 - u) * sums_[index(i, j)] + u * sums_[index(i + 1, j)]) +
           v * ((1 - u) * sums_[index(i, j + 1)] + u * sums_[index(i + 1, j + 1)]);
  }

  int width_, height_;
  std::vector<std::uint32_t> sums_;
};

double framing_scale(const MaskBox& box, double foot_x, int size_px) {
  const double half_width = std::max({foot_x - box.left, box.right - foot_x, 0.5});
  return size_px * std::min(kFramedHeight / static_cast<double>(box.height()), kFramedHalfWidth / half_width);
}

}  // namespace

void check_frame_size(int size_px) {
  if (size_px < kMinFrameSize || size_px > kMaxFrameSize)
    throw_input_error("a frame of {} pixels is out of range, expected {} to {}", size_px, kMinFrameSize,
                      kMaxFrameSize);
}

Framing framing_of(const Mask& mask, int size_px) {
  const MaskBox box = box_of(mask);
  const double foot_x = find_foot_x(mask, box);
  return {foot_x, static_cast<double>(box.bottom), framing_scale(box, foot_x, size_px), size_px};
}

/// Sets the pixels of which the tree covers at least half. A footprint smaller than a source pixel is
/// widened to one, which rounds the steps of an enlarged mask.
Mask place(const Mask& source, const Framing& framing, int px_per_block) {
  const AreaTable table(source);
  const int size_px = framing.size_px;
  const double scale = framing.frame_px_per_px * px_per_block;
  const double foot_x = framing.foot_x / px_per_block, foot_y = framing.foot_y / px_per_block;
  const double half = std::max(0.5, 0.5 / scale);
  Mask mask(size_px, size_px);
  for (int y = 0; y < size_px; ++y) {
    const double source_y = foot_y + (y + 0.5 - base_row_px(size_px)) / scale;
    for (int x = 0; x < size_px; ++x) {
      const double source_x = foot_x + (x + 0.5 - 0.5 * size_px) / scale;
      const double covered = table.area(source_x - half, source_y - half, source_x + half, source_y + half);
      mask.set(x, y, covered >= 0.5 * (2 * half) * (2 * half));
    }
  }
  return mask;
}

TargetPicture frame_mask(const Mask& mask, int size_px, const std::string& name) {
  check_frame_size(size_px);
  const MaskBox box = box_of(mask);
  if (box.is_empty()) throw_input_error("{}: shows no tree: nothing is set", name);
  const Framing framing = framing_of(mask, size_px);
  const double scale = framing.frame_px_per_px;
  TargetPicture target;
  target.mask = place(mask, framing);
  if (area_px(target.mask) == 0)
    throw_input_error("{}: shows no tree: it is too thin for a frame of {} pixels", name, size_px);
  target.tree_height_px = static_cast<float>(box.height() * scale);
  target.frame_px_per_source_px = static_cast<float>(scale);
  target.source_width_px = mask.width_px();
  target.source_height_px = mask.height_px();
  target.how = fmt::format("{}×{} px scaled by {:.3f} into a frame of {}×{}", mask.width_px(),
                           mask.height_px(), scale, size_px, size_px);
  return target;
}

}  // namespace espalier
