#include <algorithm>
#include <cmath>

#include <espalier/fitting/branches/branch_laying.h>
#include <espalier/fitting/branches/branch_refinement.h>
#include <espalier/fitting/branches/branch_tracing.h>
#include <espalier/image/reading/medial_axes.h>
#include <espalier/image/reading/roots.h>
#include <espalier/overrides/change_graph.h>

namespace espalier {

namespace {

constexpr int kDeepest = 4;           ///< levels of branching
constexpr double kMostOutward = 0.7;  ///< depth over length in the picture, of a branch on a branch
constexpr double kSteepest = 1.2;     ///< the same, of a branch on the trunk
constexpr std::size_t kBuds = 4;      ///< on each branch: where refinement may add what was not traced

/// A tree whose branches are all alike and none at random, so that overrides say what each is. False where
/// the model does not say by roles how long and how thick its trunk is.
bool make_plain(const ParameterTable& table, const MedialAxis& trunk, double metres_per_px,
                ParameterValues& values) {
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (const ParameterInfo& row = table.rows[i]; row.plain)
      values[i] = std::clamp(*row.plain, row.lower, row.upper);
  const double length_m = trunk.length_px * metres_per_px;
  const double ratio = std::max(0.004, 0.6 * trunk.width_px / trunk.length_px);
  set_role(table, {Role::levels}, kDeepest, values);
  const bool is_long = set_role(table, {Role::tree_scale}, in_own_units(table, length_m, values), values);
  return is_long &&
         (set_role(table, {Role::trunk_ratio}, ratio, values) ||
          set_role(table, {Role::trunk_radius}, in_own_units(table, ratio * length_m, values), values));
}

class Tracer {
 public:
  Tracer(const FitTask& task, const TracingSettings& settings, std::vector<MedialAxis> axes, Solution& traced)
      : key_(settings.key), axes_(std::move(axes)), traced_(traced), layer_(task) {
    children_.resize(axes_.size());
    auto [left_px, right_px] = std::pair(axes_[0].points[0].x, axes_[0].points[0].x);
    for (const MedialAxis& axis : axes_)
      for (const PixelPoint& point : axis.points)
        left_px = std::min(left_px, point.x), right_px = std::max(right_px, point.x);
    half_width_px_ = 0.5 * (right_px - left_px);
    for (std::size_t i = 1; i < axes_.size(); ++i)
      children_[static_cast<std::size_t>(axes_[i].parent)].push_back(i);
  }

  void run() { trace(0, {0}); }

 private:
  /// Lays the branch of this path on the axis, then those it bears on its children.
  void trace(std::size_t axis, const BranchPath& path) {
    const bool is_last = path.size() >= kDeepest;
    const std::size_t slots = is_last ? 0 : children_[axis].size() + kBuds;
    set_override(traced_.overrides.at(path).set,
                 {Quantity::child_count, Relation::value, static_cast<double>(slots), true});
    lay(axis, path);
    std::size_t slot = 0;
    for (std::size_t i = 0; i < children_[axis].size() && !is_last; ++i) {
      const std::size_t child = children_[axis][i];
      const auto place = static_cast<std::size_t>(axes_[child].start * static_cast<float>(slots));
      const std::size_t last = slots - (children_[axis].size() - i);  // leaves room for those that follow
      for (; slot < std::min(place, last); ++slot) leave_bud(below(path, slot));
      trace(child, below(path, slot++));
    }
    for (; slot < slots; ++slot) leave_bud(below(path, slot));
  }

  static BranchPath below(BranchPath path, std::size_t child) {
    path.push_back(static_cast<std::uint32_t>(child));
    return path;
  }

  /// A branch that is not there, but may come in refinement.
  void leave_bud(const BranchPath& path) {
    write_offsets({.path = path, .removed = true}, traced_.overrides);
  }

  void lay(std::size_t axis, const BranchPath& path) {
    constexpr double kWidthOfBase = 1.2;  // over the median of the lower third, which is what is known
    RandomStream draws(child_key(key_, axis));
    const double draw = draws.uniform_signed();
    const double outward = path.size() == 1   ? 0
                           : path.size() == 2 ? outward_of(axes_[axis], path.back(), draw)
                                              : kMostOutward * draw;
    const LineInPicture line{axes_[axis].points, kWidthOfBase * axes_[axis].width_px, outward};
    write_offsets(layer_.lay(line, path, traced_), traced_.overrides);
  }

  /// Of a branch on the trunk: its tip is in a crown that is as deep as it is wide, every other one before
  /// the trunk, and further from it than half of what is free there.
  double outward_of(const MedialAxis& axis, std::uint32_t index, double draw) const {
    const PixelPoint base = axis.points.front(), tip = axis.points.back(), foot = axes_[0].points.front();
    const double aside_px = tip.x - foot.x;
    const double free_px = std::sqrt(std::max(0.0, half_width_px_ * half_width_px_ - aside_px * aside_px));
    const double depth_px = (index % 2 == 0 ? 1 : -1) * (0.75 + 0.25 * draw) * free_px;
    return std::clamp(depth_px / std::hypot(tip.x - base.x, tip.y - base.y), -kSteepest, kSteepest);
  }

  RandomKey key_;
  std::vector<MedialAxis> axes_;
  double half_width_px_ = 0;  ///< of the crown
  std::vector<std::vector<std::size_t>> children_;
  Solution& traced_;
  BranchLayer layer_;
};

}  // namespace

namespace {

/// A traced tree is a new one, in which nothing stays as it was.
bool has_locks(const Overrides& overrides) {
  const auto locks = [&](const auto& node) { return resolved_lock(node.set, overrides).value_or(false); };
  return std::any_of(overrides.nodes.begin(), overrides.nodes.end(), locks) ||
         std::any_of(overrides.ranges.begin(), overrides.ranges.end(), locks);
}

}  // namespace

Solution trace_branches(const FitTask& task, const TracingSettings& settings, const Solution& start) {
  if (!task.model->has_branch_paths() || has_locks(start.overrides)) return start;
  const Mask& mask = task.views[0].target.mask();
  const auto shortest_px = static_cast<float>(settings.shortest * mask.height_px());
  const std::vector<MedialAxis> axes = medial_axes(without_roots(mask), shortest_px);
  if (axes.empty()) return start;
  Solution traced{start.values, start.plant_seed, {}, 1};
  if (!make_plain(task.model->table(), axes[0], task.views[0].metres_per_px, traced.values)) return start;
  Tracer(task, settings, axes, traced).run();
  traced.score = priced_score_of(task, traced);
  return traced;
}

}  // namespace espalier
