#include <algorithm>
#include <cmath>

#include <espalier/core/curves/axis.h>
#include <espalier/fitting/branches/branch_laying.h>
#include <espalier/fitting/branches/policy.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/stem_measures.h>

namespace espalier {

namespace {

constexpr std::size_t kLengthOffset = 0, kRotationOffset = 2, kPositionOffset = 5;

BranchOffsets on_side(BranchOffsets branch, int turn) {
  branch.at[kRotationOffset] = turn / (kLaying.turns / 2.0) - 1;
  return branch;
}

Vec3 unprojected(const Camera& camera, PixelPoint at, double depth_m) {
  const Ray ray = camera_ray(camera, at.x, at.y);
  const Vec3 offset_m = ray.origin_m - camera.position_m;
  const float along =
      (static_cast<float>(depth_m) - dot(offset_m, camera.forward)) / dot(ray.direction, camera.forward);
  return ray.origin_m + ray.direction * along;
}

std::size_t nearest(const std::vector<Vec3>& line, Vec3 to) {
  const auto closer = [to](Vec3 a, Vec3 b) { return length(a - to) < length(b - to); };
  return static_cast<std::size_t>(std::min_element(line.begin(), line.end(), closer) - line.begin());
}

double rms_distance(const AxisCurve& axis, const std::vector<AxisPoint>& line) {
  double sum = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double off =
        length(axis_point(axis, static_cast<double>(i) / static_cast<double>(line.size() - 1)) - line[i]);
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(line.size()));
}

/// The axis of the fewest points that lies on the line, or of as many as its length allows.
std::vector<AxisPoint> fitted_axis(const std::vector<AxisPoint>& line, double length_px, double tolerance_m) {
  std::vector<AxisPoint> points;
  for (const std::size_t count : kAxisCounts) {
    if (!points.empty() && static_cast<double>(count) * kLaying.least_px_a_point > length_px) break;
    points = fit_axis(line, count);
    if (rms_distance(make_axis(points), line) < tolerance_m) break;
  }
  return points;
}

double pixels_along(const std::vector<PixelPoint>& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i)
    sum += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
  return sum;
}

}  // namespace

BranchOffsets BranchLayer::lay(const LineInPicture& line, const BranchPath& path, const Solution& tree) {
  Solution one = branch_alone(path, tree);
  BranchOffsets branch{.path = path};
  if (path.size() > 1) {
    move_to_start(line, branch, one);
    choose_side(line, branch, one);
  }
  if (follow_line(line, branch, one)) set_radius(line.width_px, branch, one);
  return branch;
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
  ++evaluations_;
  return plant_.stems.size() > 0;
}

std::optional<Vec3> BranchLayer::base_of(const BranchOffsets& branch, Solution& one) {
  if (!grow(branch, one)) return std::nullopt;
  return plant_.knots.point_m[plant_.stems.first_knot[0]];
}

/// Secants: how far the base moves in the picture tells how far it has to.
void BranchLayer::move_to_start(const LineInPicture& line, BranchOffsets& branch, Solution& one) {
  constexpr double kFirst = 0.1;  // coordinate
  const Camera& camera = task_.views[0].camera;
  double& at = branch.at[kPositionOffset];
  const auto place_px = [&]() -> std::optional<PicturePoint> {
    const auto base_m = base_of(branch, one);
    if (!base_m) return std::nullopt;
    return project(camera, *base_m);
  };
  auto before = place_px();
  double step = kFirst;
  for (int move = 0; move < kLaying.moves && before; ++move) {
    const double from = at;
    at = std::clamp(at + step, -1.0, 1.0);
    const auto after = place_px();
    const double dx = after ? after->x_px - before->x_px : 0, dy = after ? after->y_px - before->y_px : 0;
    const double moved_px2 = dx * dx + dy * dy;
    if (!(moved_px2 > 1e-6)) {
      at = from;
      step = -step;
      continue;
    }
    const double missing_x = line.points[0].x - after->x_px, missing_y = line.points[0].y - after->y_px;
    step = (missing_x * dx + missing_y * dy) / moved_px2 * (at - from);
    before = after;
  }
  if (before) at = std::clamp(at + step, -1.0, 1.0);
}

/// The line in space, from this depth on.
void BranchLayer::lift_line(const LineInPicture& line, double depth_m) {
  const std::vector<PixelPoint> points = evenly_spaced(line.points, kLaying.points);
  const double chord_px = std::hypot(points.back().x - points.front().x, points.back().y - points.front().y);
  const double deeper_m = line.outward * chord_px * task_.views[0].metres_per_px;
  line_m_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(points.size() - 1);
    line_m_.push_back(unprojected(task_.views[0].camera, points[i], depth_m + share * deeper_m));
  }
}

/// The side of the parent from which the line leads away.
void BranchLayer::choose_side(const LineInPicture& line, BranchOffsets& branch, Solution& one) {
  std::vector<std::pair<int, Vec3>> bases;
  double depth_m = 0;
  for (int turn = 0; turn < kLaying.turns; ++turn)
    if (const auto base_m = base_of(on_side(branch, turn), one)) {
      bases.emplace_back(turn, *base_m);
      depth_m += project(task_.views[0].camera, *base_m).depth_m;
    }
  if (bases.empty()) return;
  lift_line(line, depth_m / static_cast<double>(bases.size()));
  const auto off_m = [&](const auto& base) {
    return length(base.second - line_m_[nearest(line_m_, base.second)]);
  };
  const auto best = std::min_element(bases.begin(), bases.end(),
                                     [&](const auto& a, const auto& b) { return off_m(a) < off_m(b); });
  branch = on_side(branch, best->first);
}

/// Gives the branch its axis and its length, from its base along what of the line is beyond. False where it
/// does not grow.
bool BranchLayer::follow_line(const LineInPicture& line, BranchOffsets& branch, Solution& one) {
  const auto base_m = base_of(branch, one);
  if (!base_m) return false;
  const double grown_m = ArcLengths(plant_).of_stem_m(plant_.stems, 0);
  if (branch.path.size() == 1) lift_line(line, project(task_.views[0].camera, *base_m).depth_m);
  const std::size_t least = kAxisCounts.back() + 1;
  const std::size_t first = std::min(nearest(line_m_, *base_m), line_m_.size() - least);
  std::vector<AxisPoint> beyond;
  beyond.reserve(line_m_.size() - first);
  for (std::size_t i = first; i < line_m_.size(); ++i) {
    const Vec3 from_base_m = line_m_[i] - *base_m;
    beyond.push_back({from_base_m.x, from_base_m.y, from_base_m.z});
  }
  const double share = static_cast<double>(beyond.size()) / static_cast<double>(line_m_.size());
  const double tolerance_px = std::max(kLaying.tolerance_px, kLaying.tolerance * line.width_px);
  std::vector<AxisPoint> points =
      fitted_axis(beyond, share * pixels_along(line.points), tolerance_px * task_.views[0].metres_per_px);
  const double length_m = AxisArcs(make_axis(points)).length();
  for (AxisPoint& point : points) point = point * (1 / length_m);
  branch.axis = DrawnAxis{std::move(points), AxisFrame::world};
  branch.at[kLengthOffset] += std::log(length_m / grown_m) / kBranchDimensions[kLengthOffset].range;
  return true;
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
