#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <espalier/fitting/branches/branch_laying.h>
#include <espalier/fitting/branches/branch_refinement.h>
#include <espalier/fitting/branches/branch_tracing.h>
#include <espalier/image/reading/medial_axes.h>
#include <espalier/image/reading/roots.h>

namespace espalier {

namespace {

constexpr int kDeepest = 4;           ///< levels of branching
constexpr double kMostOutward = 0.7;  ///< depth over length in the picture, of a branch
constexpr std::size_t kBuds = 4;      ///< on each branch: where refinement may add what was not traced

/// A tree whose branches are all alike and none at random, so that overrides say what each is. This function
/// knows the names of the Weber–Penn model's parameters; false for a model that lacks one of them.
bool make_plain(const ParameterTable& table, const std::vector<MedialAxis>& axes, double metres_per_px,
                ParameterValues& values) {
  bool has_all = true;
  const auto set = [&](const std::string& name, double value) {
    const auto row = table.find(name);
    has_all = has_all && row;
    if (row) values[*row] = std::clamp(value, table.rows[*row].lower, table.rows[*row].upper);
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
  return has_all;
}

class Tracer {
 public:
  Tracer(const FitTask& task, const TracingSettings& settings, std::vector<MedialAxis> axes, Solution& traced)
      : key_(settings.key), axes_(std::move(axes)), traced_(traced), layer_(task, true) {
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
    constexpr double kWidthOfBase = 1.2;  // over the median of the lower third, which is what is known
    Draws draws(child_key(key_, axis));
    const LineInPicture line{axes_[axis].points, kWidthOfBase * axes_[axis].width_px,
                             path.size() == 1 ? 0 : kMostOutward * draws.uniform_signed()};
    write_offsets(layer_.lay(line, path, traced_, draws), traced_.overrides);
  }

  RandomKey key_;
  std::vector<MedialAxis> axes_;
  std::vector<std::vector<std::size_t>> children_;
  Solution& traced_;
  BranchLayer layer_;
};

}  // namespace

Solution trace_branches(const FitTask& task, const TracingSettings& settings, const Solution& start) {
  if (!task.model->has_branch_paths() || !task.model->can_change(Quantity::seed)) return start;
  const Mask& mask = task.views[0].target.mask();
  const auto shortest_px = static_cast<float>(settings.shortest * mask.height_px());
  const std::vector<MedialAxis> axes = medial_axes(without_roots(mask), shortest_px);
  if (axes.empty()) return start;
  Solution traced{start.values, start.plant_seed, {}, 1};
  if (!make_plain(task.model->table(), axes, task.views[0].metres_per_px, traced.values)) return start;
  Tracer(task, settings, axes, traced).run();
  traced.score = score_of(task, traced);
  return traced;
}

}  // namespace espalier
