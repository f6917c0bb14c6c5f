// Which parameters a search may change, and how each maps to coordinates of the unit box [0, 1]^n
// that the optimisers know. The space is data: it is made from the model's parameter table, a start,
// and lists of free and fixed names.
//   linear       lower + u·(upper - lower)
//   logarithmic  lower·(upper / lower)^u
//   whole        equal slices of [0, 1], one a number: integers that may not be relaxed, and choices
//   sign flags   where the range spans zero: [0, 0.5) is lower..0, [0.5, 1] is 0..upper, each half linear
// A curve is searched number by number, or as a curve of fewer numbers: all such curves are among those of
// its own 7 (core/curves/curve.h).
#pragma once
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/core/parameter_table.h>

namespace espalier {

enum class Mapping { linear, logarithmic, whole };

/// One free parameter: one coordinate of the box.
struct FreeParameter {
  std::size_t row = 0;  ///< of the table
  std::string name;     ///< full name
  Mapping mapping = Mapping::linear;
  double lower = 0, upper = 1;  ///< searched values, inside the valid ones
  bool split_at_zero = false;   ///< half of the box for each sign
  std::size_t of_curve =
      0;  ///< so many in turn are the numbers of the curve whose first row this is; 0: alone
};

/// The value at `unit` (clamped to [0, 1]): inside the bounds, never -0.
double value_at(const FreeParameter& parameter, double unit);

/// The coordinate whose value lies closest to `value`: the inverse of value_at.
double unit_at(const FreeParameter& parameter, double value);

struct SearchSpace {
  ParameterValues base;  ///< values of the parameters that are not free
  std::vector<FreeParameter> free;

  std::size_t dimension() const { return free.size(); }
  /// `base` with the free parameters of `unit` (dimension() coordinates; clamped to [0, 1]): always valid.
  void decode(std::span<const double> unit, ParameterValues& values) const;
  /// The point that decode() takes back to the free parameters of `values`, each clamped to its range.
  std::vector<double> encode(std::span<const double> values) const;

 private:
  void decode_curve(std::size_t first, std::span<const double> unit, ParameterValues& values) const;
};

struct SearchRange {
  double lower = 0, upper = 0;
};

/// What the user, or the picture, says of the space.
struct SearchChoice {
  std::vector<std::string> free;  ///< names or patterns, of curves also "length_along[1]~4": by 4 numbers;
                                  ///< none: the rows free by default
  std::map<std::string, double> fixed;        ///< full names or patterns, and their values
  std::map<std::string, SearchRange> ranges;  ///< full names; neither starts nor the search leave them
};

/// Rows of the table that a pattern names: "g_scale", "curve_v[1]", "curve_v" (all levels), with * and ?
/// for any letters ("*[1]"), "default" for the rows free by default. Curves are named as a whole, and only
/// where the end of their name is spelt ("length_along[1]", "*_along"). Throws FieldError (of `field`),
/// naming the closest parameter, where there is none.
std::vector<std::size_t> rows_matching(const ParameterTable& table, const std::string& pattern,
                                       std::string_view field);

/// Sets the fixed values in `values`. Throws FieldError for unknown names and invalid values.
void apply_fixed(const ParameterTable& table, const SearchChoice& choice, ParameterValues& values);

/// Moves values that lie outside of the ranges to their ends; names that the table does not have are skipped.
void keep_in_ranges(const ParameterTable& table, const SearchChoice& choice, ParameterValues& values);

/// The space around `start` (whose free values widen the ranges that do not hold them). Ranges of rows in
/// metres are multiplied by `metre_factor` first, and cut to the ranges of `choice`. What is fixed is not
/// free. Throws FieldError for unknown names, or where nothing is left to search.
SearchSpace make_search_space(const ParameterTable& table, const ParameterValues& start,
                              const SearchChoice& choice, double metre_factor = 1);

}  // namespace espalier
