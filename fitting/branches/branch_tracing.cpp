#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <espalier/core/curves/curve.h>
#include <espalier/fitting/branches/branch_depths.h>
#include <espalier/fitting/branches/branch_laying.h>
#include <espalier/fitting/branches/branch_refinement.h>
#include <espalier/fitting/branches/branch_tracing.h>
#include <espalier/fitting/branches/policy.h>
#include <espalier/image/reading/medial_axes.h>
#include <espalier/image/reading/roots.h>
#include <espalier/overrides/change_graph.h>

namespace espalier {

namespace {

constexpr std::size_t kDeepest = 4;  ///< levels of branching
constexpr std::size_t kBuds = 4;     ///< on each branch: where refinement may add what was not traced

/// A tree whose branches are all alike and none at random, so that overrides say what each is.
void make_plain(const ParameterTable& table, const MedialAxis& trunk, double metres_per_px,
                ParameterValues& values) {
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (const ParameterInfo& row = table.rows[i]; row.plain)
      values[i] = std::clamp(*row.plain, row.lower, row.upper);
  const double length_m = trunk.length_px * metres_per_px;
  const double ratio = std::max(0.004, 0.6 * trunk.width_px / trunk.length_px);
  set_role(table, {Role::levels}, kDeepest, values);
  set_role(table, {Role::tree_scale}, in_own_units(table, length_m, values), values);
  if (!set_role(table, {Role::trunk_ratio}, ratio, values))
    set_role(table, {Role::trunk_radius}, in_own_units(table, ratio * length_m, values), values);
}

/// The radii of all branches of a level, place by place.
struct Level {
  const CurveInfo* radius_curve = nullptr;
  std::vector<double> products, squares;  ///< of wanted and grown, of grown
};

class Tracer {
 public:
  Tracer(const FitTask& task, const TracingSettings& settings, std::vector<MedialAxis> axes, Solution& traced)
      : table_(task.model->table()),
        axes_(std::move(axes)),
        deeper_px_(branch_depths_px(axes_, settings.key)),
        metres_per_px_(task.views[0].metres_per_px),
        traced_(traced),
        layer_(task) {
    children_.resize(axes_.size());
    for (std::vector<double>& deeper : deeper_px_) {
      const double base_px = deeper.front();
      for (double& at : deeper) at -= base_px;
    }
    for (std::size_t i = 1; i < axes_.size(); ++i)
      children_[static_cast<std::size_t>(axes_[i].parent)].push_back(i);
    const auto lower = [&](std::size_t a, std::size_t b) { return axes_[a].start < axes_[b].start; };
    for (std::vector<std::size_t>& of_one : children_) std::stable_sort(of_one.begin(), of_one.end(), lower);
  }

  /// Twice: radii along branches are known after the first time.
  void run() {
    trace(0, {0});
    set_radius_curves();
    knows_levels_ = true;
    traced_.overrides = {};
    trace(0, {0});
  }

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
    const LaidBranch laid =
        layer_.lay({axes_[axis].points, widths_of(axes_[axis]), deeper_px_[axis]}, path, traced_);
    write_offsets(laid.offsets, traced_.overrides);
    note_radii(laid);
    if (knows_levels_) set_own_curve(laid);
  }

  /// Branches of one level share how their radius changes along them: by least squares, place by place.
  void set_radius_curves() {
    for (const Level& level : levels_) {
      if (!level.radius_curve) continue;
      std::vector<double> factors;
      factors.reserve(level.products.size());
      for (std::size_t i = 0; i < level.products.size(); ++i)
        factors.push_back(level.products[i] / std::max(level.squares[i], 1e-12));
      const Curve curve = fit_curve(factors);
      for (std::size_t i = 0; i < kCurveRows; ++i) {
        const std::size_t row = level.radius_curve->first_row + i;
        traced_.values[row] = std::clamp(curve.numbers[i], table_.rows[row].lower, table_.rows[row].upper);
      }
    }
  }

  /// A branch whose radii its level does not have within half a pixel has a curve of its own.
  void set_own_curve(const LaidBranch& laid) {
    const CurveInfo* info = levels_[laid.offsets.path.size() - 1].radius_curve;
    const std::size_t count = laid.grown_radius_m.size();
    if (!info || count == 0) return;
    const Curve of_level = make_curve(std::span(traced_.values).subspan(info->first_row, kCurveRows));
    std::vector<double> factors;
    factors.reserve(count);
    double squares = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double off_m = laid.wanted_radius_m[i] - laid.grown_radius_m[i];
      squares += off_m * off_m;
      factors.push_back(curve_value(of_level, static_cast<double>(i) / static_cast<double>(count - 1)) *
                        laid.wanted_radius_m[i] / std::max(laid.grown_radius_m[i], 1e-6));
    }
    const double off_px = 2 * std::sqrt(squares / static_cast<double>(count)) / metres_per_px_;
    if (off_px < kLaying.tolerance_px) return;
    const Curve curve = fit_curve(factors);
    ParameterOverride own{.key = info->full_name(), .is_list = true, .is_private = true};
    for (std::size_t i = 0; i < kCurveRows; ++i) {
      const std::size_t row = info->first_row + i;
      own.numbers.push_back(std::clamp(curve.numbers[i], table_.rows[row].lower, table_.rows[row].upper));
      own.rows.push_back({static_cast<std::uint32_t>(row), own.numbers.back()});
    }
    set_parameter(traced_.overrides.at(laid.offsets.path).set, own);
  }

  void note_radii(const LaidBranch& laid) {
    Level& level = levels_[laid.offsets.path.size() - 1];
    if (laid.grown_radius_m.empty()) return;
    if (level.products.empty()) {
      level.radius_curve = layer_.radius_curve(laid.offsets.path, traced_);
      level.products.assign(laid.grown_radius_m.size(), 0);
      level.squares = level.products;
    }
    for (std::size_t i = 0; i < laid.grown_radius_m.size(); ++i) {
      level.products[i] += laid.grown_radius_m[i] * laid.wanted_radius_m[i];
      level.squares[i] += laid.grown_radius_m[i] * laid.grown_radius_m[i];
    }
  }

  /// Inside of its parent a branch is as wide as where it comes out, and so where it runs along another.
  std::vector<float> widths_of(const MedialAxis& axis) const {
    std::vector<float> widths = axis.widths_px;
    if (axis.parent < 0) return widths;
    const bool runs_along = axis.runs_along >= 0;
    const MedialAxis& beside = axes_[static_cast<std::size_t>(runs_along ? axis.runs_along : axis.parent)];
    const std::size_t from = runs_along ? axis.shared_points : 0;
    const PixelPoint fork = axis.points[from];
    const auto off_px = [&](PixelPoint at) { return std::hypot(at.x - fork.x, at.y - fork.y); };
    const auto nearest = std::min_element(beside.points.begin(), beside.points.end(),
                                          [&](PixelPoint a, PixelPoint b) { return off_px(a) < off_px(b); });
    const float inside_px =
        0.5f * beside.widths_px[static_cast<std::size_t>(nearest - beside.points.begin())];
    std::size_t out = from;
    while (out + 2 < widths.size() && off_px(axis.points[out]) < inside_px) ++out;
    const auto first = widths.begin() + static_cast<std::ptrdiff_t>(out);
    const auto last = widths.begin() + static_cast<std::ptrdiff_t>(std::min(out + 4, widths.size()));
    std::fill(widths.begin(), first, *std::min_element(first, last));
    return widths;
  }

  const ParameterTable& table_;
  std::vector<MedialAxis> axes_;
  std::vector<std::vector<double>> deeper_px_;  ///< of each point of each axis, than the foot
  std::vector<std::vector<std::size_t>> children_;
  double metres_per_px_;
  std::array<Level, kDeepest> levels_;
  bool knows_levels_ = false;  ///< how the radius of their branches changes along them
  Solution& traced_;
  BranchLayer layer_;
};

bool has_locks(const Overrides& overrides) {
  const auto locks = [&](const auto& node) { return resolved_lock(node.set, overrides).value_or(false); };
  return std::any_of(overrides.nodes.begin(), overrides.nodes.end(), locks) ||
         std::any_of(overrides.ranges.begin(), overrides.ranges.end(), locks);
}

}  // namespace

bool can_trace(const Model& model, const Overrides& overrides) {
  const ParameterTable& table = model.table();
  return model.has_branch_paths() && !has_locks(overrides) && table.find(Role::tree_scale) &&
         (table.find(Role::trunk_ratio) || table.find(Role::trunk_radius));
}

Solution trace_branches(const FitTask& task, const TracingSettings& settings, const Solution& start) {
  if (!can_trace(*task.model, start.overrides)) return start;
  const Mask& mask = task.views[0].target.mask();
  const auto shortest_px = static_cast<float>(settings.shortest * mask.height_px());
  const std::vector<MedialAxis> axes =
      medial_axes(without_roots(mask), shortest_px, static_cast<int>(kDeepest));
  if (axes.empty()) return start;
  Solution traced{start.values, start.plant_seed, {}, 1};
  make_plain(task.model->table(), axes[0], task.views[0].metres_per_px, traced.values);
  Tracer(task, settings, axes, traced).run();
  traced.score = priced_score_of(task, traced);
  return traced;
}

}  // namespace espalier
