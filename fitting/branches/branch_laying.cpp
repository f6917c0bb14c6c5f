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

std::vector<double> lengths_along_px(const std::vector<PixelPoint>& line) {
  std::vector<double> lengths{0};
  lengths.reserve(line.size());
  for (std::size_t i = 1; i < line.size(); ++i)
    lengths.push_back(lengths.back() + std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y));
  return lengths;
}

/// At `at`, of values at these places, which ascend.
double value_at(const std::vector<double>& places, const std::vector<double>& values, double at) {
  const auto above = std::upper_bound(places.begin() + 1, places.end() - 1, at) - places.begin();
  const auto after = static_cast<std::size_t>(above);
  const double piece = places[after] - places[after - 1];
  const double share = piece > 0 ? std::clamp((at - places[after - 1]) / piece, 0.0, 1.0) : 1.0;
  return std::lerp(values[after - 1], values[after], share);
}

double share_of(std::size_t index, std::size_t count) {
  return static_cast<double>(index) / static_cast<double>(count - 1);
}

/// Means over the neighbours on both sides, as far as there are any.
std::vector<double> smoothed(const std::vector<double>& values, std::size_t neighbours) {
  std::vector<double> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t on_each_side = std::min({neighbours, i, values.size() - 1 - i});
    for (std::size_t k = i - on_each_side; k <= i + on_each_side; ++k) result[i] += values[k];
    result[i] /= static_cast<double>(2 * on_each_side + 1);
  }
  return result;
}

/// Shares of the length of a line, 0 to 1, for points to which an axis is fitted: closer where it bends, so
/// that the axis has more of its own there.
std::vector<double> shares_by_bends(const std::vector<PixelPoint>& line, std::size_t count) {
  constexpr std::size_t kDense = 192, kSmooth = 4;
  const std::vector<PixelPoint> points = evenly_spaced(line, kDense);
  std::vector<double> x, y, bends(kDense, 0), places{0};
  for (const PixelPoint point : points) x.push_back(point.x), y.push_back(point.y);
  x = smoothed(smoothed(x, kSmooth), kSmooth), y = smoothed(smoothed(y, kSmooth), kSmooth);
  double sum = 0;
  for (std::size_t i = 1; i + 1 < kDense; ++i) {
    const double ax = x[i] - x[i - 1], ay = y[i] - y[i - 1], bx = x[i + 1] - x[i], by = y[i + 1] - y[i];
    bends[i] = std::fabs(std::atan2(ax * by - ay * bx, ax * bx + ay * by));
    sum += bends[i];
  }
  bends = smoothed(smoothed(bends, kSmooth), kSmooth);
  for (std::size_t i = 1; i < kDense; ++i) {
    const double bend = 0.5 * (bends[i - 1] + bends[i]) / std::max(sum, kLaying.least_bend);
    places.push_back(places.back() + 1 / static_cast<double>(kDense - 1) + kLaying.to_bends * bend);
  }
  std::vector<double> even(kDense), shares(count);
  for (std::size_t i = 0; i < kDense; ++i) even[i] = share_of(i, kDense);
  for (std::size_t i = 0; i < count; ++i)
    shares[i] = value_at(places, even, share_of(i, count) * places.back());
  return shares;
}

}  // namespace

LaidBranch BranchLayer::lay(const LineInPicture& line, const BranchPath& path, const Solution& tree) {
  Solution one = branch_alone(path, tree);
  LaidBranch laid{{.path = path}, {}, {}};
  if (path.size() > 1) {
    move_to_start(line, laid.offsets, one);
    choose_side(line, laid.offsets, one);
  }
  if (follow_line(line, laid.offsets, one) && !line.widths_px.empty()) set_radius(laid, one);
  return laid;
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
  shares_ = shares_by_bends(line.points, kLaying.points);
  const std::vector<double> at_px = lengths_along_px(line.points);
  std::vector<double> x_px, y_px;
  for (const PixelPoint point : line.points) x_px.push_back(point.x), y_px.push_back(point.y);
  const std::vector<double> widths_px(line.widths_px.begin(), line.widths_px.end());
  const double metres_per_px = task_.views[0].metres_per_px;
  const double foot_depth_m = project(task_.views[0].camera, {0, 0, 0}).depth_m;
  line_m_.clear();
  radius_m_.clear();
  for (const double share : shares_) {
    const auto here = [&](const std::vector<double>& values) {
      return values.empty() ? 0 : value_at(at_px, values, share * at_px.back());
    };
    const double at_m = depth_m + here(line.deeper_px) * metres_per_px;
    const PixelPoint point{static_cast<float>(here(x_px)), static_cast<float>(here(y_px))};
    line_m_.push_back(unprojected(task_.views[0].camera, point, at_m));
    radius_m_.push_back(0.5 * here(widths_px) * metres_per_px * at_m / foot_depth_m);
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
  first_ = std::min(nearest(line_m_, *base_m), line_m_.size() - least);
  std::vector<AxisPoint> beyond;
  beyond.reserve(line_m_.size() - first_);
  for (std::size_t i = first_; i < line_m_.size(); ++i) {
    const Vec3 from_base_m = line_m_[i] - *base_m;
    beyond.push_back({from_base_m.x, from_base_m.y, from_base_m.z});
  }
  const double share = 1 - shares_[first_];
  std::vector<AxisPoint> points = fitted_axis(beyond, share * lengths_along_px(line.points).back(),
                                              kLaying.tolerance_px * task_.views[0].metres_per_px);
  const double length_m = AxisArcs(make_axis(points)).length();
  for (AxisPoint& point : points) point = point * (1 / length_m);
  branch.axis = DrawnAxis{std::move(points), AxisFrame::world};
  branch.at[kLengthOffset] += std::log(length_m / grown_m) / kBranchDimensions[kLengthOffset].range;
  return true;
}

/// The radius at the base, by least squares of the radii along the line.
void BranchLayer::set_radius(LaidBranch& laid, Solution& one) {
  if (!grow(laid.offsets, one)) return;
  laid.grown_radius_m = radii_along_m();
  double squares = 0, products = 0;
  for (std::size_t i = 0; i < laid.grown_radius_m.size(); ++i) {
    const double place = share_of(i, laid.grown_radius_m.size());
    laid.wanted_radius_m.push_back(value_at(shares_, radius_m_, std::lerp(shares_[first_], 1.0, place)));
    squares += laid.grown_radius_m[i] * laid.grown_radius_m[i];
    products += laid.grown_radius_m[i] * laid.wanted_radius_m[i];
  }
  if (!(products > 0)) return;
  const double factor = products / squares;
  for (double& radius_m : laid.grown_radius_m) radius_m *= factor;
  const std::size_t radius = laid.offsets.at.size() - 1;
  laid.offsets.at[radius] = std::log(factor) / kBranchDimensions[radius].range;
}

/// By trying: what halves the radius where it is a half.
const CurveInfo* BranchLayer::radius_curve(const BranchPath& path, const Solution& tree) {
  constexpr double kHalf = 0.5;
  Solution one = branch_alone(path, tree);
  if (!grow({.path = path}, one)) return nullptr;
  const double neutral_m = radii_along_m().front();
  for (const CurveInfo& curve : task_.model->table().curves) {
    if (curve.level + 1 != static_cast<int>(path.size()) || curve.argument != CurveArgument::along_itself ||
        curve.role != CurveRole::factor)
      continue;
    Solution halved = one;
    std::fill_n(halved.values.begin() + static_cast<std::ptrdiff_t>(curve.first_row), kCurveRows, kHalf);
    if (grow({.path = path}, halved) &&
        std::fabs(radii_along_m().front() - kHalf * neutral_m) < 0.01 * neutral_m)
      return &curve;
  }
  return nullptr;
}

/// Of the branch that was grown last, at places evenly spaced along it.
std::vector<double> BranchLayer::radii_along_m() const {
  const std::size_t begin = plant_.stems.first_knot[0], end = plant_.stems.first_knot[1];
  std::vector<double> at_m{0}, radius_m{plant_.knots.radius_m[begin]}, result;
  for (std::size_t k = begin + 1; k < end; ++k) {
    at_m.push_back(at_m.back() + length(plant_.knots.point_m[k] - plant_.knots.point_m[k - 1]));
    radius_m.push_back(plant_.knots.radius_m[k]);
  }
  for (std::size_t i = 0; i < kLaying.points; ++i)
    result.push_back(value_at(at_m, radius_m, share_of(i, kLaying.points) * at_m.back()));
  return result;
}

}  // namespace espalier
