// The step of the (1+1) evolution strategy that refines a branch follows the success rule
// [Rechenberg: one success in five]: it grows by half with each success and shrinks by .92 with each failure,
// inside of its limits. A model that decides by itself which candidates are better notes what it is asked to
// grow; how far candidates lie from the branch they come from shows the step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <espalier/fitting/branches/branch_offsets.h>
#include <espalier/fitting/branches/branch_refinement.h>
#include <espalier/overrides/change_graph.h>

#include "support/hand_made_plants.h"

namespace espalier {
namespace {

using Point = std::array<double, kBranchDimensions.size()>;

enum class Outcome { better, equal, worse };

struct Candidate {
  Point at;
  bool removed = false;
};

bool same(const Point& a, const Point& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::fabs(a[i] - b[i]) > 1e-5) return false;
  return true;
}

/// A trunk of one pixel with a branch above it, a pole 10 px wide. As it is at first, the branch is 30 px
/// tall; each candidate is one pixel taller than the one before, as tall, or less.
class WatchedModel : public Model {
 public:
  explicit WatchedModel(Outcome outcome) : outcome_(outcome) {}
  const ParameterTable& table() const override { return table_; }
  bool has_branch_paths() const override { return true; }
  bool can_change(Quantity quantity) const override { return quantity != Quantity::seed; }
  GrowthEstimate estimate(std::span<const double>) const override { return {2, 0}; }
  GrowthResult generate(std::span<const double>, Seed, const GrowthSettings& settings,
                        Plant& plant) const override {
    plant.clear();
    const PlantPart* part = settings.only_part;
    if (!part || part->path.size() == 1) add_cylinder(plant, {0, 0, 0}, {0, 0, 0.1f}, 0.05f);
    if (!part || part->path.size() == 2) grow_branch(settings, part != nullptr, plant);
    return {};
  }

  mutable std::vector<Candidate> asked;

 private:
  void grow_branch(const GrowthSettings& settings, bool is_asked, Plant& plant) const {
    const BranchChange* change = ChangeCursor(settings.changes).child(0).child(0).change();
    Candidate candidate{};
    for (std::size_t i = 0; change && i < candidate.at.size(); ++i) {
      const BranchDimension& d = kBranchDimensions[i];
      const Modification& by = (*change)[d.quantity];
      candidate.at[i] = (d.relation == Relation::factor ? std::log(by.factor) : by.offset) / d.range;
    }
    candidate.removed = change && change->removed;
    if (is_asked) asked.push_back(candidate);
    if (candidate.removed) return;
    const float length_m = same(candidate.at, {}) ? 3 : length_of(asked.size());
    const Vec3 points[] = {{0, 0, 0.1f}, {0, 0, 0.1f + length_m}};
    const float radii[] = {0.5f, 0.5f};
    add_stem(plant, points, radii, 1);
    plant.stems.origin.back() = 0;
  }
  float length_of(std::size_t asked_before) const {
    if (outcome_ == Outcome::worse) return 2;
    return outcome_ == Outcome::equal ? 3 : 3 + 0.1f * static_cast<float>(asked_before);
  }

  ParameterTable table_{"watched", {}};
  Outcome outcome_;
};

/// The target is a pole 100 px tall, 10 m.
FitTask watched_task(const Model& model) {
  Mask mask(128, 128);
  for (int y = 26; y < 126; ++y)
    for (int x = 59; x < 69; ++x) mask.set(x, y);
  FitTask task;
  task.model = &model;
  task.plant_seeds = {1};
  task.objective = parse_objective("iou");
  const Camera camera = frame_base({0, 0, 0}, {}, 0.1f, 128, 128, 126);
  task.views = {{camera, PreparedTarget(mask), camera.metres_per_px}};
  return task;
}

/// By step: how far coordinates moved from the branch before, in units of the expected step.
using Moves = std::vector<std::vector<double>>;

/// Adds the moves of the candidates from `first` on. A removed branch is a failure. Coordinates near their
/// limits are left out: moves from there are cut.
void add_moves(const std::vector<Candidate>& asked, std::size_t first, Point at, Outcome outcome,
               const std::vector<double>& steps, Moves& moves) {
  moves.resize(steps.size());
  for (std::size_t step = 0; step < steps.size(); ++step) {
    const Candidate& candidate = asked.at(first + step);
    if (candidate.removed) continue;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double moved = std::fabs(candidate.at[i] - at[i]);
      if (moved > 1e-5 && std::fabs(at[i]) < 0.5) moves[step].push_back(moved / steps[step]);
    }
    if (outcome != Outcome::worse) at = candidate.at;
  }
}

/// The median of |N(0, 1)| is .6745.
void expect_normal(Moves& moves) {
  for (std::size_t step = 0; step < moves.size(); ++step) {
    std::vector<double>& of_step = moves[step];
    ASSERT_GT(of_step.size(), 200u) << step;
    const auto middle = of_step.begin() + static_cast<std::ptrdiff_t>(of_step.size() / 2);
    std::nth_element(of_step.begin(), middle, of_step.end());
    const double error = 1 / (2 * 0.6356 * std::sqrt(static_cast<double>(of_step.size())));
    EXPECT_NEAR(*middle, 0.6745, 5 * error) << "step " << step;
  }
}

/// The step before each candidate where a removal counts as a failure.
std::vector<double> expected_steps(const std::vector<Candidate>& asked, std::size_t first, std::size_t count,
                                   double sigma, Outcome outcome) {
  std::vector<double> steps;
  for (std::size_t step = 0; step < count; ++step) {
    steps.push_back(sigma);
    const Outcome now = asked.at(first + step).removed ? Outcome::worse : outcome;
    if (now == Outcome::better) sigma = std::min(0.5, 1.5 * sigma);
    if (now == Outcome::worse) sigma = std::max(0.01, 0.92 * sigma);
  }
  return steps;
}

Moves moves_of_refinement(Outcome outcome, std::size_t first_step, std::size_t count) {
  Moves moves;
  for (Seed seed = 0; seed < 250; ++seed) {
    const WatchedModel model(outcome);
    const FitTask task = watched_task(model);
    Solution solution;
    const long steps = static_cast<long>(first_step + count);
    refine_branches(task, {.order = 1, .steps = steps, .key = root_key(seed)}, solution);
    // The first branch asked for is the one to start from; after each visit's last step comes none.
    const std::size_t first = 1 + first_step;
    const Point at = first_step == 0 ? Point{} : model.asked[first - 1].at;
    add_moves(model.asked, first, outcome == Outcome::worse ? Point{} : at, outcome,
              expected_steps(model.asked, first, count, 0.15, outcome), moves);
  }
  return moves;
}

TEST(StepOfRefinement, ShrinksWithEachFailureToItsFloor) {
  Moves moves = moves_of_refinement(Outcome::worse, 0, 48);
  expect_normal(moves);
}

/// From the floor, it begins anew with the next visit, of 24 steps each.
TEST(StepOfRefinement, BeginsAnewWhereAVisitEndsAtTheFloor) {
  Moves moves = moves_of_refinement(Outcome::worse, 48, 24);
  expect_normal(moves);
}

TEST(StepOfRefinement, GrowsWithEachSuccessToItsCeiling) {
  Moves moves = moves_of_refinement(Outcome::better, 0, 12);
  expect_normal(moves);
}

TEST(StepOfRefinement, StaysWhereACandidateIsAsGood) {
  Moves moves = moves_of_refinement(Outcome::equal, 0, 3);
  expect_normal(moves);
}

}  // namespace
}  // namespace espalier
