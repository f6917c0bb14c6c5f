#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/fitting/picture/crown_reading.h>
#include <espalier/image/masks/mask_box.h>
#include <espalier/image/masks/row_runs.h>

namespace espalier {

namespace {

/// A row of the crown: its height, and where it begins and ends.
struct OutlineRow {
  double z, left, right;
};

/// The largest number of those up to `reach` places away; of each place.
std::vector<double> largest_nearby(const std::vector<double>& numbers, std::size_t reach) {
  std::vector<double> largest(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t first = i - std::min(i, reach), end = std::min(numbers.size(), i + reach + 1);
    largest[i] = *std::max_element(numbers.begin() + static_cast<std::ptrdiff_t>(first),
                                   numbers.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return largest;
}

/// Fills dips of less than twice the reach: a closing.
std::vector<double> without_dips(const std::vector<double>& all, std::size_t reach) {
  std::vector<double> numbers = largest_nearby(all, reach);
  for (double& number : numbers) number = -number;
  numbers = largest_nearby(numbers, reach);
  for (double& number : numbers) number = -number;
  return numbers;
}

/// Of a mask, from the top down, relative to its height and its foot; gaps between clumps of leaves are
/// filled.
std::vector<OutlineRow> outline_of(const Mask& mask, const PictureReading& reading) {
  constexpr double kGapsClosed = 0.03;  ///< of the height
  const MaskBox box = box_of(mask);
  const double height = box.height();
  const std::vector<RowRun> foot = runs_of(mask, box.bottom - 1);
  const double foot_x = 0.5 * (foot.front().first + foot.back().last + 1);
  std::vector<double> z, left, right;
  for (int y = box.top; y < box.bottom - box.rows(reading.crown_base); ++y) {
    const std::vector<RowRun> runs = runs_of(mask, y);
    if (runs.empty()) continue;
    z.push_back((box.bottom - y - 0.5) / height);
    left.push_back((foot_x - runs.front().first) / height);
    right.push_back((runs.back().last + 1 - foot_x) / height);
  }
  const auto reach = static_cast<std::size_t>(std::max(1, box.rows(kGapsClosed)));
  const std::vector<double> filled_left = without_dips(left, reach),
                            filled_right = without_dips(right, reach);
  std::vector<OutlineRow> rows(z.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool is_end = i == 0 || i + 1 == rows.size();
    rows[i] = {z[i], -(is_end ? left : filled_left)[i], (is_end ? right : filled_right)[i]};
  }
  return rows;
}

/// A point of the profile between apex (1 up, 0 out) and rim (0 up, 1 out).
struct ProfilePoint {
  double out, up;
};

/// A point of the plane of the picture.
struct Corner {
  double x, z;
};

/// Of one side, the rows between apex and rim.
template <typename XOf>
void add_profile(const std::vector<OutlineRow>& rows, const Corner& apex, const Corner& rim, const XOf& x_of,
                 std::vector<ProfilePoint>& points) {
  for (const OutlineRow& row : rows) {
    const double up = (row.z - rim.z) / (apex.z - rim.z), out = (x_of(row) - apex.x) / (rim.x - apex.x);
    if (up > 0 && up < 1 && std::isfinite(out)) points.push_back({std::clamp(out, 0.0, 1.0), up});
  }
}

struct ShapeFit {
  double shape = 2, squares = 0;
};

/// The C of out^C + up^C = 1 with the least squares of `out`, by the golden section on its logarithm.
ShapeFit fit_shape(const std::vector<ProfilePoint>& points) {
  if (points.empty()) return {};
  const auto squares = [&](double log_shape) {
    const double shape = std::exp(log_shape);
    double sum = 0;
    for (const ProfilePoint& point : points)
      sum += std::pow(point.out - std::pow(1 - std::pow(point.up, shape), 1 / shape), 2);
    return sum;
  };
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double lower = std::log(0.3), upper = std::log(10);
  while (upper - lower > 0.01) {
    const double a = upper - golden * (upper - lower), b = lower + golden * (upper - lower);
    const bool is_lower = squares(a) < squares(b);
    (is_lower ? upper : lower) = is_lower ? b : a;
  }
  const double middle = (lower + upper) / 2;
  return {std::exp(middle), squares(middle)};
}

/// Where one side is widest, at the height from which its profiles to top and base fit best: steps of a tenth
/// of the crown's depth, then of a fifth of that.
template <typename XOf>
Corner rim_of(const std::vector<OutlineRow>& rows, const Corner& top, const Corner& base, double x,
              const XOf& x_of) {
  const auto squares = [&](double z) {
    std::vector<ProfilePoint> above, below;
    add_profile(rows, top, {x, z}, x_of, above);
    add_profile(rows, base, {x, z}, x_of, below);
    return fit_shape(above).squares + fit_shape(below).squares;
  };
  const double depth = top.z - base.z;
  double best_z = base.z + depth / 2, least = squares(best_z);
  for (const double step : {depth / 10, depth / 50}) {
    const double around = best_z;
    for (int k = -4; k <= 4; ++k)
      if (const double value = squares(around + k * step); value < least)
        least = value, best_z = around + k * step;
  }
  return {x, best_z};
}

}  // namespace

CrownReading read_crown(const Mask& mask, const PictureReading& reading) {
  const std::vector<OutlineRow> rows = outline_of(mask, reading);
  if (rows.size() < 3) throw_input_error("picture: got a crown of {} rows, expected 3 or more", rows.size());
  const auto left_of = [](const OutlineRow& row) { return row.left; };
  const auto right_of = [](const OutlineRow& row) { return row.right; };
  const auto middle = [](const OutlineRow& row) { return 0.5 * (row.left + row.right); };
  const double half_row = 0.5 / reading.height_px;
  const Corner top{middle(rows.front()), rows.front().z + half_row},
      base{middle(rows.back()), rows.back().z - half_row};
  const double left_x = std::ranges::min_element(rows, {}, &OutlineRow::left)->left,
               right_x = std::ranges::max_element(rows, {}, &OutlineRow::right)->right;
  const Corner left = rim_of(rows, top, base, left_x, left_of),
               right = rim_of(rows, top, base, right_x, right_of);
  std::vector<ProfilePoint> above, below;
  add_profile(rows, top, left, left_of, above);
  add_profile(rows, top, right, right_of, above);
  add_profile(rows, base, left, left_of, below);
  add_profile(rows, base, right, right_of, below);
  const double least = 1.0 / reading.height_px;
  return {.top = top.z,
          .top_x = top.x,
          .base = base.z,
          .base_x = base.x,
          .radius_right = std::max(right.x, least),
          .radius_left = std::max(-left.x, least),
          .rim_right = right.z,
          .rim_left = left.z,
          .shape_above = fit_shape(above).shape,
          .shape_below = fit_shape(below).shape};
}

CrownShape crown_shape_of(const CrownReading& crown, double height_m) {
  const auto m = [&](double share) { return static_cast<float>(height_m * share); };
  const auto apex_x = [&](double x) {
    return m(std::clamp(x, -0.9 * crown.radius_left, 0.9 * crown.radius_right));
  };
  const float depth_radius_m = m((crown.radius_right + crown.radius_left) / 2),
              depth_rim_m = m((crown.rim_right + crown.rim_left) / 2);
  return {.top_m = {apex_x(crown.top_x), 0, m(crown.top)},
          .bottom_m = {apex_x(crown.base_x), 0, m(crown.base)},
          .radius_m = {m(crown.radius_right), depth_radius_m, m(crown.radius_left), depth_radius_m},
          .rim_m = {m(crown.rim_right), depth_rim_m, m(crown.rim_left), depth_rim_m},
          .shape_above = static_cast<float>(crown.shape_above),
          .shape_below = static_cast<float>(crown.shape_below)};
}

std::string crown_text(const CrownReading& crown, double height_m) {
  const CrownShape shape = crown_shape_of(crown, height_m);
  return fmt::format(
      "crown(top = {:.3g}, top_x = {:.3g}, bottom = {:.3g}, bottom_x = {:.3g}, radius = {:.3g}, "
      "radius_right = {:.3g}, radius_left = {:.3g}, rim = {:.3g}, rim_right = {:.3g}, rim_left = {:.3g}, "
      "shape_above = {:.2f}, shape_below = {:.2f})",
      shape.top_m.z, shape.top_m.x, shape.bottom_m.z, shape.bottom_m.x, shape.radius_m[1], shape.radius_m[0],
      shape.radius_m[2], shape.rim_m[1], shape.rim_m[0], shape.rim_m[2], shape.shape_above,
      shape.shape_below);
}

}  // namespace espalier
