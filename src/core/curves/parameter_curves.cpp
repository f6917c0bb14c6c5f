#include <Eigen/QR>
#include <algorithm>

#include <espalier/core/curves/parameter_curves.h>
#include <espalier/core/error.h>

namespace espalier {

static_assert(kCurveRows == kCurveNumbers);

namespace {

std::span<const double> numbers_of(const CurveInfo& curve, std::span<const double> values) {
  return values.subspan(curve.first_row, kCurveRows);
}

void check_density(const CurveInfo& curve, std::span<const double> values, std::string_view where) {
  const auto numbers = numbers_of(curve, values);
  if (curve.role != CurveRole::density ||
      std::any_of(numbers.begin(), numbers.end(), [](double number) { return number > 0; }))
    return;
  throw_input_error("{}: key '{}': got a density of 0 everywhere, expected a number above 0", where,
                    curve.full_name());
}

Curve refined(std::span<const double> numbers, const CurveInfo& curve, std::string_view where) {
  try {
    return make_curve(numbers);
  } catch (const InputError& error) {
    throw_input_error("{}: key '{}': {}", where, curve.full_name(), error.what());
  }
}

/// What refines `count` numbers to 7, a column a number.
Eigen::MatrixXd refinement(std::size_t count) {
  Eigen::MatrixXd matrix(kCurveNumbers, static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> unit(count, 0.0);
    unit[i] = 1;
    const Curve curve = make_curve(unit);
    matrix.col(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::VectorXd>(curve.numbers.data(), kCurveNumbers);
  }
  return matrix;
}

}  // namespace

void set_curve(const ParameterTable& table, const CurveInfo& curve, std::span<const double> numbers,
               std::string_view where, ParameterValues& values) {
  const ParameterInfo& row = table.rows[curve.first_row];
  for (const double number : numbers)
    if (!is_valid_value(row, number))
      throw_input_error("{}: key '{}': got {}, expected {}", where, curve.full_name(), number,
                        describe_valid_values(row));
  const Curve full = refined(numbers, curve, where);
  for (std::size_t i = 0; i < kCurveRows; ++i)
    values[curve.first_row + i] = std::clamp(full.numbers[i], row.lower, row.upper) + 0.0;  // never -0
  check_density(curve, values, where);
}

void check_densities(const ParameterTable& table, std::span<const double> values, std::string_view where) {
  for (const CurveInfo& curve : table.curves) check_density(curve, values, where);
}

std::vector<double> shortest_numbers(const CurveInfo& curve, std::span<const double> values) {
  const auto numbers = numbers_of(curve, values);
  const bool is_constant =
      std::all_of(numbers.begin(), numbers.end(), [&](double number) { return number == numbers[0]; });
  return {numbers.begin(), is_constant ? numbers.begin() + 1 : numbers.end()};
}

std::vector<double> coarse_numbers(const CurveInfo& curve, std::span<const double> values,
                                   std::size_t count) {
  const auto numbers = numbers_of(curve, values);
  if (count == kCurveNumbers) return {numbers.begin(), numbers.end()};
  const Eigen::VectorXd nearest = refinement(count).colPivHouseholderQr().solve(
      Eigen::Map<const Eigen::VectorXd>(numbers.data(), kCurveNumbers));
  return {nearest.begin(), nearest.end()};
}

}  // namespace espalier
