#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <espalier/fitting/branches/branch_offsets.h>
#include <espalier/fitting/branches/branch_refinement.h>
#include <espalier/fitting/branches/policy.h>
#include <espalier/fitting/branches/reach_limit.h>
#include <espalier/fitting/branches/step_size.h>
#include <espalier/fitting/optimizers/random_stream.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/render/grow_and_draw.h>

namespace espalier {

namespace {

/// One a view; then, where the task expects leaves, what leaves cover of each.
using Masks = std::vector<Mask>;

constexpr double kFirstSigma = 0.15;  ///< of the evolution strategy, and after it has narrowed to the least

struct Branch : BranchOffsets {
  double sigma = kFirstSigma;
  Masks masks;
  float too_far_m = 0;        ///< it reaches further than is plausible
  bool bears_locked = false;  ///< a locked branch stands on it, and is to stay as it is
};

/// What would change more of a locked branch than its place: such a branch may be turned and bent alone.
bool is_held(std::size_t dimension, const Branch& branch) {
  const Quantity quantity = kBranchDimensions[dimension].quantity;
  return branch.bears_locked && (quantity == Quantity::length || quantity == Quantity::radius);
}

Branch read_branch(const BranchPath& path, const Overrides& overrides) {
  return {read_offsets(path, overrides), kFirstSigma, {}, 0, false};
}

/// Draws plants and parts of them.
class Drawer {
 public:
  explicit Drawer(const FitTask& task)
      : task_(task), has_leaves_(expects_leaves(task)), renderer_(task.make_renderer()) {}

  /// `are_locked` gets of each stem whether it is; null: nobody asks.
  bool draw(const Solution& solution, const PlantPart* part, Masks& masks,
            std::vector<bool>* are_locked = nullptr) {
    const ChangeGraph graph(solution.overrides);
    std::vector<ChangeCursor> cursors;
    GrowthSettings growth = task_.growth;
    growth.changes = &graph;
    growth.only_part = part;
    if (are_locked) growth.stem_cursors = &cursors;
    plant_.clear();
    const std::size_t views = task_.views.size();
    masks.resize(has_leaves_ ? 2 * views : views);
    const bool grown = task_.model->generate(solution.values, solution.plant_seed, growth, plant_).grown;
    for (std::size_t i = 0; i < views; ++i) {
      const Camera& camera = task_.views[i].camera;
      masks[i].reset(camera.width_px, camera.height_px);
      if (has_leaves_) masks[views + i].reset(camera.width_px, camera.height_px);
      if (grown)
        draw_view(*renderer_, plant_, {&camera, &masks[i], has_leaves_ ? &masks[views + i] : nullptr});
    }
    if (are_locked) {
      are_locked->assign(plant_.stems.size(), false);
      for (std::size_t stem = 0; stem < cursors.size(); ++stem)
        (*are_locked)[stem] = cursors[stem].is_locked();
    }
    return grown;
  }
  const Plant& plant() const { return plant_; }

 private:
  const FitTask& task_;
  bool has_leaves_;
  std::unique_ptr<SilhouetteRenderer> renderer_;
  Plant plant_;
};

double score_of_drawn(const FitTask& task, const Masks& masks) {
  const std::span all(masks);
  return score_of_masks(task, all.first(task.views.size()), all.subspan(task.views.size()));
}

double price_of_numbers(const FitTask& task, const Solution& solution) {
  return task.freedom.price * static_cast<double>(count_numbers(solution.overrides));
}

void join(Masks& all, const Masks& more) {
  for (std::size_t v = 0; v < all.size(); ++v)
    for (std::size_t w = 0; w < all[v].words().size(); ++w) all[v].words()[w] |= more[v].words()[w];
}

class Refinement {
 public:
  Refinement(const FitTask& task, const RefinementSettings& settings, Solution& solution)
      : task_(task),
        settings_(settings),
        solution_(solution),
        drawer_(task),
        reach_limit_(task),
        draws_(settings.key),
        freedom_(task.freedom) {
    find_branches();
  }

  long run() {
    long steps = 0;
    std::vector<std::size_t> order(branches_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    while (steps < settings_.steps && !branches_.empty()) {
      shuffle(order);
      for (const std::size_t index : order)
        if (steps < settings_.steps) steps += visit(branches_[index]);
    }
    finish();
    return steps;
  }

 private:
  void shuffle(std::vector<std::size_t>& order) {
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[draws_.below(i)]);
  }

  /// The order of a branch is the length of its path: stems that split off a trunk are of order 1, as are its
  /// children. Removed ones are found by their overrides. Locked ones, and what is on them, stay as they are.
  void find_branches() {
    Masks all;
    std::vector<bool> are_locked;
    drawer_.draw(solution_, nullptr, all, &are_locked);
    fixed_ = all;
    for (Mask& mask : fixed_) mask.clear();
    const auto length = static_cast<std::size_t>(settings_.order) + 1;
    std::vector<PlantPart> fixed;
    std::vector<BranchPath> locked;
    const Plant& plant = drawer_.plant();
    for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
      const BranchPath path = path_of(plant, stem);
      if (path.size() == length && are_locked[stem])
        fixed.push_back({path});
      else if (path.size() == length)
        branches_.push_back(read_branch(path, solution_.overrides));
      if (path.size() < length) fixed.push_back({path, true});
      if (path.size() > length && are_locked[stem]) locked.push_back(path);
    }
    const ChangeGraph graph(solution_.overrides);
    for (const OverrideNode& node : solution_.overrides.nodes)
      if (node.path.size() == length && removes(node) && !is_locked(node.path, graph))
        branches_.push_back(read_branch(node.path, solution_.overrides));
    for (Branch& branch : branches_) branch.bears_locked = is_below_any(branch.path, locked);
    draw_all(fixed);
  }

  /// Of a branch that is not there, so that it has no position.
  static bool is_locked(const BranchPath& path, const ChangeGraph& graph) {
    ChangeCursor cursor(&graph);
    for (const std::uint32_t part : path) cursor = cursor.child(part, -1);
    return cursor.is_locked();
  }

  static bool is_below_any(const BranchPath& path, const std::vector<BranchPath>& others) {
    return std::any_of(others.begin(), others.end(), [&](const BranchPath& other) {
      return std::equal(path.begin(), path.end(), other.begin(),
                        other.begin() + static_cast<std::ptrdiff_t>(path.size()));
    });
  }

  void draw_all(const std::vector<PlantPart>& fixed) {
    if (branches_.empty()) return;
    Masks masks;
    for (const PlantPart& part : fixed) {
      drawer_.draw(solution_, &part, masks);
      join(fixed_, masks);
    }
    for (Branch& branch : branches_) {
      Solution one = branch_alone(branch.path, solution_);
      draw(branch, one);
    }
  }

  /// The branch alone, as it is now. `one` is the tree as far as it concerns the branch.
  void draw(Branch& branch, Solution& one) {
    const PlantPart part{branch.path};
    write_offsets(branch, one.overrides);
    drawer_.draw(one, &part, branch.masks);
    branch.too_far_m = reach_limit_.excess_m(drawer_.plant());
  }

  Masks rest_of(const Branch& branch) const {
    Masks rest = fixed_;
    for (const Branch& other : branches_)
      if (&other != &branch) join(rest, other.masks);
    return rest;
  }

  double score(const Masks& rest, const Branch& branch) {
    joined_ = rest;
    join(joined_, branch.masks);
    return score_of_drawn(task_, joined_);
  }

  Branch mutated(const Branch& branch) {
    Branch child = branch;
    if (!branch.bears_locked && draws_.chance(branch.removed ? kBranchStep.returns : kBranchStep.removes)) {
      child.removed = !child.removed;
      if (child.removed) return freedom_.price > 0 ? removed_alone(child) : child;
      if (child.axis) return child;  // where it was
      for (std::size_t i = 0; i < child.at.size(); ++i)
        child.at[i] =
            clamped(i, freedom_.share * kBranchStep.return_spread * draws_.normal(), freedom_.share);
      return child;
    }
    if (!branch.bears_locked && draws_.chance(kBranchStep.reseeds) &&
        task_.model->can_change(Quantity::seed)) {
      child.seed = 1 + draws_.below(1'000'000);
      return child;
    }
    if (freedom_.price > 0 && draws_.chance(kBranchStep.forgets)) {
      forget_one(child);
      return child;
    }
    if (child.axis && draws_.chance(kBranchStep.moves_points)) {
      move_points(child);
      return child;
    }
    const bool all = draws_.chance(kBranchStep.moves_all);
    for (std::size_t i = 0; i < child.at.size(); ++i)
      if (!is_idle(i, child) && !is_held(i, child) && (all || draws_.chance(kBranchStep.moves_each)))
        child.at[i] = moved(i, child.at[i], freedom_.share * child.sigma * draws_.normal());
    return child;
  }

  /// An offset that was laid beyond its range does not go further, and need not come back.
  double moved(std::size_t dimension, double from, double step) const {
    const double to = clamped(dimension, from + step, freedom_.share);
    return std::clamp(from + step, std::min(from, to), std::max(from, to));
  }

  /// One point of the axis, or all from it on. Where one view alone shows the branch, in that view's plane:
  /// of the depth it would say nothing.
  void move_points(Branch& branch) {
    std::vector<AxisPoint>& points = branch.axis->points;
    const Camera& camera = task_.views[0].camera;
    const double range = freedom_.share * kBranchStep.point_range * branch.sigma;
    const Vec3 step =
        camera.right * static_cast<float>(range * draws_.normal()) +
        camera.up * static_cast<float>(range * draws_.normal()) +
        camera.forward * (task_.views.size() > 1 ? static_cast<float>(range * draws_.normal()) : 0);
    const std::size_t first = draws_.below(points.size());
    const std::size_t end = draws_.chance(0.5) ? first + 1 : points.size();
    for (std::size_t i = first; i < end; ++i) points[i] = points[i] + AxisPoint{step.x, step.y, step.z};
  }

  /// Where numbers have a price, a branch that is gone has no others.
  static Branch removed_alone(const Branch& branch) {
    Branch alone = branch;
    alone.at = {};
    alone.axis.reset();
    alone.seed = 0;
    return alone;
  }

  /// An offset or the seed, whichever is drawn; the model gives it again what it gives.
  void forget_one(Branch& branch) {
    const std::size_t i = draws_.below(branch.at.size() + 1);
    if (i == branch.at.size() ? branch.bears_locked : is_held(i, branch)) return;
    if (i < branch.at.size())
      branch.at[i] = 0;
    else
      branch.seed = 0;
  }

  double price_of(const Branch& branch) const {
    return freedom_.price * static_cast<double>(count_numbers(branch));
  }

  int visit(Branch& branch) {
    const Masks rest = rest_of(branch);
    Solution one = branch_alone(branch.path, solution_);
    double best = score(rest, branch) + price_of(branch);
    for (int step = 0; step < settings_.steps_per_visit; ++step) {
      Branch candidate = mutated(branch);
      draw(candidate, one);
      const double value = score(rest, candidate) + price_of(candidate);
      if (value <= best && candidate.too_far_m <= branch.too_far_m) {
        if (value < best) candidate.sigma = wider(candidate.sigma);
        best = value;
        branch = std::move(candidate);
      } else {
        branch.sigma = narrower(branch.sigma);
      }
    }
    if (branch.sigma == kNarrowestStep) branch.sigma = kFirstSigma;
    return settings_.steps_per_visit;
  }

  void finish() {
    for (const Branch& branch : branches_) write_offsets(branch, solution_.overrides);
    std::erase_if(solution_.overrides.nodes, [](const OverrideNode& node) { return node.set.empty(); });
    Masks masks;
    drawer_.draw(solution_, nullptr, masks);
    solution_.score = score_of_drawn(task_, masks) + price_of_numbers(task_, solution_);
  }

  const FitTask& task_;
  const RefinementSettings& settings_;
  Solution& solution_;
  Drawer drawer_;
  ReachLimit reach_limit_;
  RandomStream draws_;
  Freedom freedom_;
  std::vector<Branch> branches_;
  Masks fixed_, joined_;
};

}  // namespace

double score_of(const FitTask& task, const Solution& solution) {
  Masks masks;
  Drawer(task).draw(solution, nullptr, masks);
  return score_of_drawn(task, masks);
}

double priced_score_of(const FitTask& task, const Solution& solution) {
  return score_of(task, solution) + price_of_numbers(task, solution);
}

long refine_branches(const FitTask& task, const RefinementSettings& settings, Solution& solution) {
  Solution refined = solution;
  const long steps = Refinement(task, settings, refined).run();
  if (refined.score <= solution.score) solution = std::move(refined);  // else: a bit lost in writing it down
  return steps;
}

}  // namespace espalier
