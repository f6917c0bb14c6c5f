// Curves of a parameter table: 1, 4, 5 or 7 numbers as a user gives them become the rows of a curve.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include <espalier/core/curves/curve.h>
#include <espalier/core/parameter_table.h>

namespace espalier {

/// Sets the rows of the curve to 1, 4, 5 or 7 numbers, refined without a change. Throws InputError, opened by
/// `where`, for other counts, for numbers that a row does not accept, and for a density that is 0 everywhere.
void set_curve(const ParameterTable& table, const CurveInfo& curve, std::span<const double> numbers,
               std::string_view where, ParameterValues& values);

/// Throws InputError, opened by `where`, where a density is 0 everywhere.
void check_densities(const ParameterTable& table, std::span<const double> values, std::string_view where);

/// The numbers to write of a curve: one where all are equal.
std::vector<double> shortest_numbers(const CurveInfo& curve, std::span<const double> values);

/// The curve of 4, 5 or 7 numbers that is nearest to the rows of a curve, by least squares of the numbers:
/// what make_curve refines to these rows where there is one.
std::vector<double> coarse_numbers(const CurveInfo& curve, std::span<const double> values, std::size_t count);

}  // namespace espalier
