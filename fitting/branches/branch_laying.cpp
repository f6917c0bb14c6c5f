#include <cmath>

#include <espalier/fitting/branches/branch_laying.h>
#include <espalier/fitting/branches/policy.h>
#include <espalier/fitting/branches/step_size.h>
#include <espalier/overrides/change_graph.h>

namespace espalier {

namespace {

BranchOffsets turned(BranchOffsets branch, int turn) {
  branch.at[2] = turn / (kLaying.first_turns / 2.0) - 1;
  return branch;
}

}  // namespace

BranchOffsets BranchLayer::lay(const LineInPicture& line, const BranchPath& path, const Solution& tree,
                               RandomStream& draws) {
  target_ = evenly_spaced(line.points, kLaying.points);
  outward_ = line.outward;
  Solution one = branch_alone(path, tree);
  BranchOffsets best{.path = path};
  double best_error = error_of(best, one);
  for (int turn = 0; turn < kLaying.first_turns; ++turn) try_one(turned(best, turn), one, best, best_error);
  double sigma = kLaying.first_sigma;
  for (int step = 0; step < kLaying.steps; ++step) {
    const bool better = try_one(mutated(best, sigma, draws), one, best, best_error);
    sigma = better ? wider(sigma) : narrower(sigma);
  }
  set_radius(line.width_px, best, one);
  return best;
}

BranchOffsets BranchLayer::mutated(BranchOffsets branch, double sigma, RandomStream& draws) const {
  if (reseeds_ && draws.chance(kLaying.reseeds)) branch.seed = 1 + draws.below(1'000'000);
  for (std::size_t i = 0; i + 1 < branch.at.size(); ++i)  // all but the radius
    if (draws.chance(kLaying.moves_each)) branch.at[i] = clamped(i, branch.at[i] + sigma * draws.normal());
  return branch;
}

bool BranchLayer::try_one(const BranchOffsets& branch, Solution& one, BranchOffsets& best,
                          double& best_error) {
  const double error = error_of(branch, one);
  if (error >= best_error) return false;
  best = branch, best_error = error;
  return true;
}

/// Grows the branch alone; false where there is none.
bool BranchLayer::grow(const BranchOffsets& branch, Solution& one) {
  write_offsets(branch, one.overrides);
  const ChangeGraph graph(one.overrides);
  const PlantPart part{branch.path, true};
  GrowthSettings growth = task_.growth;
  growth.changes = &graph;
  growth.only_part = &part;
  growth.prune_to = nullptr;  // what lies on a line of the picture is inside of its outline
  growth.train = false;
  plant_.clear();
  task_.model->generate(one.values, one.plant_seed, growth, plant_);
  return plant_.stems.size() > 0;
}

/// Mean square of the distance to the line, in pixels.
double BranchLayer::error_of(const BranchOffsets& branch, Solution& one) {
  if (!grow(branch, one)) return 1e12;
  grown_.clear();
  const Camera& camera = task_.views[0].camera;
  PicturePoint first{}, last{};
  for (std::size_t knot = plant_.stems.first_knot[0]; knot < plant_.stems.first_knot[1]; ++knot) {
    last = project(camera, plant_.knots.point_m[knot]);
    if (grown_.empty()) first = last;
    grown_.push_back({last.x_px, last.y_px});
  }
  const std::vector<PixelPoint> points = evenly_spaced(grown_, kLaying.points);
  double sum = 0;
  for (std::size_t i = 0; i < kLaying.points; ++i)
    sum += std::pow(points[i].x - target_[i].x, 2) + std::pow(points[i].y - target_[i].y, 2);
  const double length_px =
      std::hypot(target_.back().x - target_.front().x, target_.back().y - target_.front().y);
  const double depth_px = (last.depth_m - first.depth_m) / task_.views[0].metres_per_px;
  return sum / kLaying.points + kLaying.depth_weight * std::pow(depth_px - outward_ * length_px, 2);
}

void BranchLayer::set_radius(double width_px, BranchOffsets& branch, Solution& one) {
  if (!grow(branch, one)) return;
  const double grown_m = plant_.knots.radius_m[plant_.stems.first_knot[0]];
  const double seen_m = 0.5 * width_px * task_.views[0].metres_per_px;
  const std::size_t radius = branch.at.size() - 1;
  if (grown_m > 0)
    branch.at[radius] = clamped(radius, std::log(seen_m / grown_m) / kBranchDimensions[radius].range);
}

}  // namespace espalier
