#include "fitting/stages/branch_tracing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "fitting/optimizers/draws.h"
#include "fitting/stages/branch_offsets.h"
#include "fitting/stages/branch_refinement.h"
#include "image/medial_axes.h"
#include "overrides/change_graph.h"
#include "plant/flatten.h"

namespace espalier {

namespace {

constexpr std::size_t kPoints = 9;    ///< compared along an axis
constexpr int kDeepest = 4;           ///< levels of branching
constexpr double kMostOutward = 0.7;  ///< depth over length in the picture, of a branch
constexpr double kDepthWeight = 0.1;  ///< of errors in depth, against those in the picture
constexpr std::size_t kBuds = 4;      ///< on each branch: where refinement may add what was not traced
constexpr int kSteps = 700;           ///< of the evolution strategy, for each branch

using Offsets = decltype(BranchOffsets::at);

/// A tree whose branches are all alike and none at random, so that overrides say what each is. This function
/// knows the names of the Weber–Penn model's parameters.
void make_plain(const ParameterTable& table, const std::vector<MedialAxis>& axes, double metres_per_px,
                ParameterValues& values) {
  const auto set = [&](const std::string& name, double value) {
    if (const auto row = table.find(name))
      values[*row] = std::clamp(value, table.rows[*row].lower, table.rows[*row].upper);
  };
  set("levels", kDeepest);
  set("g_scale", axes[0].length_px * metres_per_px);
  set("ratio", std::max(0.004, 0.6 * axes[0].width_px / axes[0].length_px));
  set("shape", 3);  // cylindrical: one length at all heights
  for (const char* name : {"shape_mix", "base_splits", "tropism_x", "tropism_y", "tropism_z", "g_scale_v",
                           "prune_ratio", "flare"})
    set(name, 0);
  set("ratio_power", 1.2);
  const std::map<const char*, double> of_level{
      {"base_size", 0},  {"down_angle", 50}, {"down_angle_v", 0}, {"rotate", 180},
      {"rotate_v", 0},   {"length", 0.5},    {"length_v", 0},     {"taper", 0.75},
      {"seg_splits", 0}, {"curve_res", 6},   {"curve", 0},        {"curve_back", 0},
      {"curve_v", 50},   {"bend_v", 0},      {"branch_dist", 0},  {"radius_mod", 1}};
  for (int level = 0; level < kDeepest; ++level)
    for (const auto& [name, value] : of_level)
      set(std::string(name) + "[" + std::to_string(level) + "]", value);
  set("length[0]", 1);
  set("down_angle[0]", 0);
  for (const char* name : {"branches[1]", "branches[2]", "branches[3]"})
    set(name, 2);  // overrides count them
}

class Tracer {
 public:
  Tracer(const FitTask& task, const TracingSettings& settings, std::vector<MedialAxis> axes, Solution& traced)
      : task_(task), key_(settings.key), axes_(std::move(axes)), traced_(traced) {
    children_.resize(axes_.size());
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
    Draws draws(child_key(key_, axis));
    target_ = evenly_spaced(axes_[axis].points, kPoints);
    outward_ = path.size() == 1 ? 0 : kMostOutward * draws.uniform_signed();
    Solution one = only(path, traced_);
    BranchOffsets best{.path = path};
    double best_error = error_of(best, one);
    for (int turn = 0; turn < 12; ++turn) try_one(turned(best, turn), one, best, best_error);
    double sigma = 0.2;
    for (int step = 0; step < kSteps; ++step) {
      const bool better = try_one(mutated(best, sigma, draws), one, best, best_error);
      sigma = better ? std::min(0.5, 1.5 * sigma) : std::max(0.01, 0.92 * sigma);
    }
    set_radius(axis, best, one);
    write_offsets(best, traced_.overrides);
  }

  static BranchOffsets turned(BranchOffsets branch, int turn) {
    branch.at[2] = turn / 6.0 - 1;
    return branch;
  }

  static BranchOffsets mutated(BranchOffsets branch, double sigma, Draws& draws) {
    if (draws.chance(0.15)) branch.seed = 1 + draws.below(1'000'000);
    for (std::size_t i = 0; i + 1 < branch.at.size(); ++i)  // all but the radius
      if (draws.chance(0.5)) branch.at[i] = clamped(i, branch.at[i] + sigma * draws.normal());
    return branch;
  }

  bool try_one(const BranchOffsets& branch, Solution& one, BranchOffsets& best, double& best_error) {
    const double error = error_of(branch, one);
    if (error >= best_error) return false;
    best = branch, best_error = error;
    return true;
  }

  /// Grows the branch alone; false where there is none.
  bool grow(const BranchOffsets& branch, Solution& one) {
    write_offsets(branch, one.overrides);
    const ChangeGraph graph(one.overrides);
    const PlantPart part{branch.path, true};
    GrowthSettings growth = task_.growth;
    growth.changes = &graph;
    growth.only_part = &part;
    growth.prune_to = nullptr;  // what lies on an axis is inside of the outline
    growth.train = false;
    plant_.clear();
    task_.model->generate(one.values, one.plant_seed, growth, plant_);
    return plant_.stems.size() > 0;
  }

  /// Mean square of the distance to the axis, in pixels.
  double error_of(const BranchOffsets& branch, Solution& one) {
    if (!grow(branch, one)) return 1e12;
    line_.clear();
    const Camera& camera = task_.views[0].camera;
    PicturePoint first{}, last{};
    for (std::size_t knot = plant_.stems.first_knot[0]; knot < plant_.stems.first_knot[1]; ++knot) {
      last = project(camera, plant_.knots.point_m[knot]);
      if (line_.empty()) first = last;
      line_.push_back({last.x_px, last.y_px});
    }
    const std::vector<PixelPoint> grown = evenly_spaced(line_, kPoints);
    double sum = 0;
    for (std::size_t i = 0; i < kPoints; ++i)
      sum += std::pow(grown[i].x - target_[i].x, 2) + std::pow(grown[i].y - target_[i].y, 2);
    const double length_px =
        std::hypot(target_.back().x - target_.front().x, target_.back().y - target_.front().y);
    const double depth_px = (last.depth_m - first.depth_m) / task_.views[0].metres_per_px;
    return sum / kPoints + kDepthWeight * std::pow(depth_px - outward_ * length_px, 2);
  }

  void set_radius(std::size_t axis, BranchOffsets& branch, Solution& one) {
    if (!grow(branch, one)) return;
    const double grown_m = plant_.knots.radius_m[plant_.stems.first_knot[0]];
    const double seen_m = 0.6 * axes_[axis].width_px * task_.views[0].metres_per_px;
    const std::size_t radius = branch.at.size() - 1;
    if (grown_m > 0)
      branch.at[radius] = clamped(radius, std::log(seen_m / grown_m) / kBranchDimensions[radius].range);
  }

  const FitTask& task_;
  RandomKey key_;
  std::vector<MedialAxis> axes_;
  std::vector<std::vector<std::size_t>> children_;
  Solution& traced_;
  Plant plant_;
  std::vector<PixelPoint> target_, line_;
  double outward_ = 0;  ///< depth over length of the axis that is traced
};

}  // namespace

Solution trace_branches(const FitTask& task, const TracingSettings& settings, const Solution& start) {
  if (!task.model->has_branch_paths()) return start;
  const Mask& mask = task.views[0].target.mask();
  const auto shortest_px = static_cast<float>(settings.shortest * mask.height_px());
  const std::vector<MedialAxis> axes = medial_axes(mask, shortest_px);
  if (axes.empty()) return start;
  Solution traced{start.values, start.plant_seed, {}, 1};
  make_plain(task.model->table(), axes, task.views[0].metres_per_px, traced.values);
  Tracer(task, settings, axes, traced).run();
  traced.score = score_of(task, traced);
  return traced;
}

}  // namespace espalier
