#include <algorithm>
#include <cmath>

#include <espalier/fitting/branches/branch_depths.h>
#include <espalier/fitting/branches/policy.h>
#include <espalier/fitting/optimizers/random_stream.h>

namespace espalier {

namespace {

double distance_px(PixelPoint a, PixelPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

std::size_t nearest_point(const std::vector<PixelPoint>& line, PixelPoint to) {
  const auto closer = [to](PixelPoint a, PixelPoint b) { return distance_px(a, to) < distance_px(b, to); };
  return static_cast<std::size_t>(std::min_element(line.begin(), line.end(), closer) - line.begin());
}

/// Of branches on the trunk: how steep they may be, and how far between the draw and the crown's edge.
struct DepthReach {
  double steepest = kDepth.steepest, outermost = 0;
};

class DepthPlan {
 public:
  DepthPlan(const std::vector<MedialAxis>& axes, RandomKey key) : axes_(axes) {
    auto [left_px, right_px] = std::pair(axes[0].points[0].x, axes[0].points[0].x);
    for (const MedialAxis& axis : axes)
      for (const PixelPoint& point : axis.points)
        left_px = std::min(left_px, point.x), right_px = std::max(right_px, point.x);
    half_width_px_ = 0.5 * (right_px - left_px);
    middle_px_ = 0.5 * (right_px + left_px);
    draws_.reserve(axes.size());
    for (std::size_t i = 0; i < axes.size(); ++i)
      draws_.push_back(RandomStream(child_key(key, i)).uniform_signed());
  }

  double half_width_px() const { return half_width_px_; }

  std::vector<std::vector<double>> depths_px(const DepthReach& reach) const {
    std::vector<std::vector<double>> depths;
    depths.reserve(axes_.size());
    int on_trunk = 0;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const bool is_limb = axes_[i].parent == 0 && axes_[i].runs_along < 0;
      depths.push_back(depths_of(i, is_limb ? (on_trunk++ % 2 == 0 ? 1 : -1) : 0, reach, depths));
    }
    return depths;
  }

 private:
  /// `side` of the trunk on which a branch on it lies; 0 for others.
  std::vector<double> depths_of(std::size_t i, int side, const DepthReach& reach,
                                const std::vector<std::vector<double>>& before) const {
    const MedialAxis& axis = axes_[i];
    if (axis.parent < 0) return std::vector<double>(axis.points.size(), 0);
    const std::size_t from = axis.runs_along < 0 ? 0 : axis.shared_points;
    const auto beside = static_cast<std::size_t>(axis.runs_along < 0 ? axis.parent : axis.runs_along);
    const std::vector<double>& there = before[beside];
    const double base_px = there[nearest_point(axes_[beside].points, axis.points[from])];
    std::vector<double> depths(there.begin(), there.begin() + static_cast<std::ptrdiff_t>(from));
    std::vector<double> along_px{0};
    for (std::size_t k = from + 1; k < axis.points.size(); ++k)
      along_px.push_back(along_px.back() + distance_px(axis.points[k - 1], axis.points[k]));
    const double tip_px = tip_depth_px(axis, from, base_px, side, draws_[i], reach);
    for (const double at_px : along_px)
      depths.push_back(base_px + at_px / std::max(along_px.back(), 1e-6) * (tip_px - base_px));
    return depths;
  }

  /// In a crown that is as deep as it is wide.
  double tip_depth_px(const MedialAxis& axis, std::size_t from, double base_px, int side, double draw,
                      const DepthReach& reach) const {
    const PixelPoint tip = axis.points.back();
    const double chord_px = distance_px(axis.points[from], tip), aside_px = tip.x - middle_px_;
    const double free_px = std::sqrt(std::max(0.0, half_width_px_ * half_width_px_ - aside_px * aside_px));
    if (side == 0)
      return std::clamp(base_px + kDepth.outward * draw * chord_px, std::min(base_px, -free_px),
                        std::max(base_px, free_px));
    const double wanted_px = side * std::lerp(0.75 + 0.25 * draw, 1.0, reach.outermost) * free_px;
    return base_px + std::clamp(wanted_px - base_px, -reach.steepest * chord_px, reach.steepest * chord_px);
  }

  const std::vector<MedialAxis>& axes_;
  double half_width_px_ = 0, middle_px_ = 0;  ///< of the crown
  std::vector<double> draws_;
};

double extent_px(const std::vector<std::vector<double>>& depths) {
  double least = 0, most = 0;
  for (const std::vector<double>& axis : depths)
    for (const double depth : axis) least = std::min(least, depth), most = std::max(most, depth);
  return most - least;
}

}  // namespace

std::vector<std::vector<double>> branch_depths_px(const std::vector<MedialAxis>& axes, RandomKey key) {
  const DepthPlan plan(axes, key);
  DepthReach reach;
  std::vector<std::vector<double>> depths = plan.depths_px(reach);
  while (extent_px(depths) < kDepth.over_width * 2 * plan.half_width_px() && reach.outermost < 1) {
    if (reach.steepest < kDepth.most_steep)
      reach.steepest = std::min(1.1 * reach.steepest, kDepth.most_steep);
    else
      reach.outermost = std::min(reach.outermost + 0.2, 1.0);
    depths = plan.depths_px(reach);
  }
  return depths;
}

}  // namespace espalier
