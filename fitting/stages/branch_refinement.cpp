#include "fitting/stages/branch_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "fitting/optimizers/draws.h"
#include "overrides/change_graph.h"

namespace espalier {

namespace {

using Masks = std::vector<Mask>;  ///< one a view

constexpr std::size_t kDimensions = 6;
using Offsets = std::array<double, kDimensions>;

struct Dimension {
  Quantity quantity;
  Relation relation;
  double range;  ///< of the offset at coordinate ±1; of a factor: its logarithm
};

/// How far a branch may go from what the model gives it.
constexpr std::array<Dimension, kDimensions> kSearched{{
    {Quantity::length, Relation::factor, 1.1},
    {Quantity::down_angle, Relation::offset, 70},
    {Quantity::rotation, Relation::offset, 180},
    {Quantity::curvature, Relation::offset, 120},
    {Quantity::position, Relation::offset, 0.3},
    {Quantity::radius, Relation::factor, 0.7},
}};

// Of the evolution strategy: its step, in coordinates of kSearched, and by how much a success or a failure
// changes it [Rechenberg's rule of one success in five: 1.5 · 0.92^4 is about 1].
constexpr double kFirstSigma = 0.15, kWidest = 0.5, kNarrowest = 0.01, kWiden = 1.5, kNarrow = 0.92;

struct Branch {
  BranchPath path;
  Offsets at{};
  std::uint64_t seed = 0;
  bool removed = false;
  double sigma = kFirstSigma;
  Masks masks;
};

bool is_removed(const OverrideNode& node) {
  return std::any_of(node.set.overrides.begin(), node.set.overrides.end(), [](const Override& entry) {
    return entry.quantity == Quantity::removed && entry.number != 0;
  });
}

/// Sets what differs from the model, and takes out what no longer does.
void set_or_drop(OverrideSet& set, const Override& entry, bool differs) {
  if (differs) return set_override(set, entry);
  std::erase_if(set.overrides, [&](const Override& other) { return other.quantity == entry.quantity; });
}

void write_overrides(const Branch& branch, Overrides& overrides) {
  OverrideSet& set = overrides.at(branch.path).set;
  for (std::size_t i = 0; i < kDimensions; ++i) {
    const Dimension& d = kSearched[i];
    if (d.quantity == Quantity::position && branch.path.size() == 1) continue;
    const double x = branch.at[i] * d.range;
    set_or_drop(set, {d.quantity, d.relation, d.relation == Relation::factor ? std::exp(x) : x, true},
                x != 0);
  }
  set_or_drop(set, {Quantity::seed, Relation::value, static_cast<double>(branch.seed), true},
              branch.seed != 0);
  set_or_drop(set, {Quantity::removed, Relation::value, 1, true}, branch.removed);
}

void read_override(const Override& entry, Branch& branch) {
  if (entry.quantity == Quantity::seed) branch.seed = static_cast<std::uint64_t>(entry.number);
  for (std::size_t i = 0; i < kDimensions; ++i) {
    if (kSearched[i].quantity != entry.quantity || kSearched[i].relation != entry.relation) continue;
    const bool is_factor = entry.relation == Relation::factor;
    branch.at[i] = (is_factor ? std::log(entry.number) : entry.number) / kSearched[i].range;
  }
}

Branch read_branch(const BranchPath& path, const Overrides& overrides) {
  Branch branch{.path = path};
  const OverrideNode* node = overrides.find(path);
  if (!node) return branch;
  branch.removed = is_removed(*node);
  for (const Override& entry : node->set.overrides) read_override(entry, branch);
  return branch;
}

/// Draws plants and parts of them.
class Drawer {
 public:
  explicit Drawer(const FitTask& task) : task_(task), renderer_(task.make_renderer()) {}

  bool draw(const Solution& solution, const PlantPart* part, Masks& masks) {
    const ChangeGraph graph(solution.overrides);
    GrowthSettings growth = task_.growth;
    growth.changes = &graph;
    growth.only_part = part;
    plant_.clear();
    masks.resize(task_.views.size());
    const bool grown = task_.model->generate(solution.values, solution.plant_seed, growth, plant_).grown;
    for (std::size_t i = 0; i < masks.size(); ++i) {
      const Camera& camera = task_.views[i].camera;
      masks[i].reset(camera.width_px, camera.height_px);
      if (grown) renderer_->draw(plant_, camera, masks[i]);
    }
    return grown;
  }
  const Plant& plant() const { return plant_; }

 private:
  const FitTask& task_;
  std::unique_ptr<SilhouetteRenderer> renderer_;
  Plant plant_;
};

double mean_dissimilarity(const FitTask& task, const Masks& masks) {
  double sum = 0;
  for (std::size_t i = 0; i < masks.size(); ++i)
    sum += dissimilarity(task.objective, masks[i], task.views[i].target);
  return sum / static_cast<double>(masks.size());
}

void join(Masks& all, const Masks& more) {
  for (std::size_t v = 0; v < all.size(); ++v)
    for (std::size_t w = 0; w < all[v].words().size(); ++w) all[v].words()[w] |= more[v].words()[w];
}

class Refinement {
 public:
  Refinement(const FitTask& task, const RefinementSettings& settings, Solution& solution)
      : task_(task), settings_(settings), solution_(solution), drawer_(task), draws_(settings.key) {
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
  /// children. Removed ones are found by their overrides.
  void find_branches() {
    Masks all;
    drawer_.draw(solution_, nullptr, all);
    fixed_ = all;
    for (Mask& mask : fixed_) mask.clear();
    const auto length = static_cast<std::size_t>(settings_.order) + 1;
    std::vector<BranchPath> above;
    const Plant& plant = drawer_.plant();
    for (std::size_t stem = 0; stem < plant.stems.size(); ++stem) {
      const BranchPath path = path_of(plant, stem);
      if (path.size() == length) branches_.push_back(read_branch(path, solution_.overrides));
      if (path.size() < length) above.push_back(path);
    }
    for (const OverrideNode& node : solution_.overrides.nodes)
      if (node.path.size() == length && is_removed(node))
        branches_.push_back(read_branch(node.path, solution_.overrides));
    draw_all(above);
  }

  void draw_all(const std::vector<BranchPath>& above) {
    if (branches_.empty()) return;
    Masks masks;
    for (const BranchPath& path : above) {
      const PlantPart part{path, true};
      drawer_.draw(solution_, &part, masks);
      join(fixed_, masks);
    }
    for (Branch& branch : branches_) {
      Solution one = only(branch);
      draw(branch, one);
    }
  }

  /// The branch alone, as it is now. `one` is the tree as far as it concerns the branch.
  void draw(Branch& branch, Solution& one) {
    const PlantPart part{branch.path};
    write_overrides(branch, one.overrides);
    drawer_.draw(one, &part, branch.masks);
  }

  /// What the branch's growth depends on: its own node, those above and those below.
  Solution only(const Branch& branch) const {
    Solution one{solution_.values, solution_.plant_seed, {}, 1};
    for (const OverrideNode& node : solution_.overrides.nodes) {
      const std::size_t shared = std::min(node.path.size(), branch.path.size());
      if (std::equal(node.path.begin(), node.path.begin() + static_cast<std::ptrdiff_t>(shared),
                     branch.path.begin()))
        one.overrides.nodes.push_back(node);
    }
    return one;
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
    return mean_dissimilarity(task_, joined_);
  }

  Branch mutated(const Branch& branch) {
    Branch child = branch;
    if (draws_.chance(branch.removed ? 0.3 : 0.04)) {
      child.removed = !child.removed;
      return child;
    }
    if (draws_.chance(0.08)) {
      child.seed = 1 + draws_.below(1'000'000);
      return child;
    }
    const bool all = draws_.chance(0.3);
    for (double& x : child.at)
      if (all || draws_.chance(0.4)) x = std::clamp(x + child.sigma * draws_.normal(), -1.0, 1.0);
    return child;
  }

  int visit(Branch& branch) {
    const Masks rest = rest_of(branch);
    Solution one = only(branch);
    double best = score(rest, branch);
    for (int step = 0; step < settings_.steps_per_visit; ++step) {
      Branch candidate = mutated(branch);
      draw(candidate, one);
      const double value = score(rest, candidate);
      if (value <= best) {
        const double sigma = candidate.sigma * (value < best ? kWiden : 1);
        best = value;
        branch = std::move(candidate);
        branch.sigma = std::min(kWidest, sigma);
      } else {
        branch.sigma = std::max(kNarrowest, branch.sigma * kNarrow);
      }
    }
    if (branch.sigma == kNarrowest) branch.sigma = kFirstSigma;
    return settings_.steps_per_visit;
  }

  void finish() {
    for (const Branch& branch : branches_) write_overrides(branch, solution_.overrides);
    std::erase_if(solution_.overrides.nodes, [](const OverrideNode& node) {
      return node.set.overrides.empty() && node.set.shares.empty();
    });
    Masks masks;
    drawer_.draw(solution_, nullptr, masks);
    solution_.score = mean_dissimilarity(task_, masks);
  }

  const FitTask& task_;
  const RefinementSettings& settings_;
  Solution& solution_;
  Drawer drawer_;
  Draws draws_;
  std::vector<Branch> branches_;
  Masks fixed_, joined_;
};

}  // namespace

double score_of(const FitTask& task, const Solution& solution) {
  Masks masks;
  Drawer(task).draw(solution, nullptr, masks);
  return mean_dissimilarity(task, masks);
}

long refine_branches(const FitTask& task, const RefinementSettings& settings, Solution& solution) {
  Solution refined = solution;
  const long steps = Refinement(task, settings, refined).run();
  if (refined.score <= solution.score) solution = std::move(refined);  // else: a bit lost in writing it down
  return steps;
}

}  // namespace espalier
