// The parameter table of a model: one row a parameter. Reading presets, validation, the search
// space, the command line and the docs are all made from it (docs/architecture.md).
// A parameter with a value at each level of branching has one row a level: "curve_v[2]". A curve, a parameter
// that changes along a stem, has a row for each of its numbers: "length_along[1].3".
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/core/parameter_codec.h>
#include <espalier/core/parameter_role.h>

namespace espalier {

enum class Scale { linear, logarithmic, integer, choice };

/// What a negative value means where the sign is a flag and not a magnitude.
enum class SignMeaning { number, flag };

/// How the magnitudes on the two sides of a flag compare, for whoever blends two plants.
enum class FlagSides {
  one_measure,   ///< the same measure of two kinds: a count of children, or of children in a fan
  meet_at_zero,  ///< two effects; at zero neither is there
  unrelated      ///< two measures that have nothing in common
};

/// Of a row that no branch can have for itself, as the whole plant has one; of one that all can.
inline constexpr int kNoBranch = -1, kAnyBranch = 1'000'000;

struct ParameterInfo {
  std::string name;                           ///< without the level: "curve_v"
  int level = -1;                             ///< level of branching 0..3, or -1 for the whole plant
  int point = -1;                             ///< of a curve: which of its numbers, from 0; else -1
  std::string unit;                           ///< "m", "deg", "1" for ratios and counts
  double lower = 0, upper = 1;                ///< valid values, both ends included
  double search_lower = 0, search_upper = 1;  ///< where a search looks unless told otherwise
  Scale scale = Scale::linear;
  SignMeaning sign = SignMeaning::number;
  double default_value = 0;
  bool free_by_default = false;  ///< part of the default search space
  bool relaxable = false;        ///< an integer that may be fractional: the last child grows in proportion
  std::vector<std::string> choices;  ///< names of choices; the value of choice i is first_choice + i
  int first_choice = 0;
  FlagSides sides = FlagSides::unrelated;  ///< where the sign is a flag
  const ParameterCodec* codec = nullptr;   ///< of a model whose values need one of their own; not owned
  int least_levels = 0;  ///< means nothing to a plant with fewer levels of branching than these
  std::vector<std::string> needs =
      {};  ///< means nothing where all these rows (full names) are 0; none: always means
  std::string part_of =
      {};  ///< of what some plants lack: the row (full name) that is 0 in those, also its own
  bool says_nothing_at_default = false;  ///< a row that was added later and that most plants leave alone
  std::string mixed_with = {},
              mixed_by = {};  ///< of a choice: rows of a second choice, and of the share that one has
  RoleOfLevel role = {};      ///< what it is to a fit
  int deepest_branch =
      kNoBranch;  ///< branches from the trunk, 0, to this level can have a value of their own
  std::optional<double> plain = {};  ///< its value in a plain tree, whose stems are straight and all alike
  std::string symbol;                ///< the paper's name, where it has another one
  std::string help;                  ///< one line

  /// "curve_v[2]", "g_scale" where there is no level, "length_along[1].3" of the third number of a curve.
  std::string full_name() const;
};

/// What a curve is a function of, from 0 to 1.
enum class CurveArgument {
  place_on_parent,  ///< of children: from the parent's bare base to its tip
  along_itself      ///< from the stem's base to its tip
};

/// What becomes of its values.
enum class CurveRole {
  factor,
  offset,  ///< added
  density  ///< of children; only relative values count
};

inline constexpr std::size_t kCurveRows = 7;  ///< of each curve, one after the other

/// What the rows of one curve are together (core/curves/curve.h).
struct CurveInfo {
  std::string name;  ///< without the level: "length_along"
  int level = -1;    ///< as of its rows
  std::size_t first_row = 0;
  CurveArgument argument = CurveArgument::along_itself;
  CurveRole role = CurveRole::factor;
  double neutral = 1;  ///< where all numbers are this, nothing changes

  /// "length_along[1]", or "leaf_scale_along" where there is no level.
  std::string full_name() const;
};

/// One value per row of the table, in its order. Whole numbers are stored as doubles.
using ParameterValues = std::vector<double>;

struct ParameterTable {
  std::string model;  ///< "weber_penn"
  std::vector<ParameterInfo> rows;
  std::vector<CurveInfo> curves = {};  ///< in the order of their rows

  std::optional<std::size_t> find(std::string_view full_name) const;
  /// The row that bears the role; roles that go by level are of `level`.
  std::optional<std::size_t> find(Role role, int level = -1) const;
  /// The row index; throws InputError naming the closest known parameter where there is none.
  std::size_t index_of(std::string_view full_name) const;
  ParameterValues defaults() const;
  /// The curve of this full name; nullptr where there is none.
  const CurveInfo* find_curve(std::string_view full_name) const;
  /// The curve that a row is a number of; nullptr where it is of none.
  const CurveInfo* curve_of(std::size_t row) const;
};

/// Whether the curve changes nothing.
bool is_neutral(const CurveInfo& curve, std::span<const double> values);

/// Rows that say something of the plant: all but those of neutral curves, those that are part of what it
/// lacks, and those that say nothing at their default. Only these are written to files and are columns of
/// spaces, so a model can get new parts and its old plants stay as they are.
std::vector<bool> rows_in_use(const ParameterTable& table, std::span<const double> values);

/// Sets the row of this role, if there is one, to the valid value nearest to `value`. False where there is
/// none.
bool set_role(const ParameterTable& table, RoleOfLevel role, double value, ParameterValues& values);

/// Multiplies all values in metres by `factor` (clamped to what is valid): a similar plant.
void scale_plant(const ParameterTable& table, double factor, ParameterValues& values);

/// A length in the units of a plant's lengths: metres, unless a row says how many make a unit of the model's.
double in_own_units(const ParameterTable& table, double length_m, const ParameterValues& values);

/// The rows that one key of a file sets, in the order of its array: the levels of "curve_v", the components
/// of "tropism" (tropism_x, _y, _z); one row for "g_scale", "curve_v[2]" or "length_along[1].3"; none where
/// the key is unknown. The rows of a curve go together by its name (find_curve).
std::vector<std::size_t> rows_of_key(const ParameterTable& table, std::string_view key);

/// The valid value that is nearest to `value`, rounded where it must be whole; of NaN the least.
double nearest_valid_value(const ParameterInfo& row, double value);

/// What a message expects of a value: "a whole number 1..40", "one of off, on (or 0..1)".
std::string describe_valid_values(const ParameterInfo& row);

/// Finite, whole where it must be, and inside the bounds.
bool is_valid_value(const ParameterInfo& row, double value);

/// Throws InputError unless `value` is finite, whole where it must be, and inside the bounds.
/// `where` opens the message: a file and line, or the command-line option.
void check_value(const ParameterInfo& row, double value, std::string_view where);

}  // namespace espalier
