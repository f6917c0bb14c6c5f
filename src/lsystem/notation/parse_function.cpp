#include <filesystem>
#include <limits>

#include <espalier/core/curves/func_file.h>
#include <espalier/core/files.h>
#include <espalier/lsystem/notation/parse_appearance.h>
#include <espalier/lsystem/notation/parse_function.h>
#include <espalier/lsystem/notation/parse_parameter.h>
#include <espalier/lsystem/notation/parse_surroundings.h>

namespace espalier::lsystem {

namespace {

constexpr std::uintmax_t kMostFunctionBytes = 1u << 20;

std::vector<double> parse_curve_numbers(Cursor& cursor) {
  const Position position = cursor.position();
  cursor.expect("[");
  std::vector<double> numbers;
  do numbers.push_back(parse_number(cursor, "a finite number"));
  while (cursor.take(","));
  cursor.expect("]");
  try {
    make_curve(numbers);
  } catch (const InputError& error) {
    throw_at(position, "{}", error.what());
  }
  return numbers;
}

std::vector<PlanePoint> read_function_file(const std::string& file, const Position& position) {
  try {
    if (!file.ends_with(".func"))
      throw_input_error("got file \"{}\", expected one that ends with .func", file);
    const std::filesystem::path path = file_beside(file, *position.source);
    std::error_code none;
    const std::uintmax_t bytes = std::filesystem::file_size(path, none);
    if (!none && bytes > kMostFunctionBytes)
      throw_input_error("{}: got {} bytes, expected at most {}", file, bytes, kMostFunctionBytes);
    return read_func_points(read_file(path, kMostTextBytes), file);
  } catch (const InputError& error) {
    throw_at(position, "{}", error.what());
  }
}

/// The numbers that follow a file's function, inside of the bounds that are given for them.
void follow_file(const std::vector<PlanePoint>& points, const ParameterInfo* bounds, const Position& position,
                 FunctionDeclaration& function) {
  constexpr double kAnything = std::numeric_limits<double>::max();
  const ValueRange values = func_range(points), range = bounds ? ValueRange{bounds->lower, bounds->upper}
                                                               : ValueRange{-kAnything, kAnything};
  if (values.lower < range.lower || values.upper > range.upper)
    throw_at(position, "{}: got values from {:.6g} to {:.6g}, expected them in {} .. {}", function.file,
             values.lower, values.upper, range.lower, range.upper);
  const NearestCurve nearest = nearest_curve(points, range);
  function.numbers.assign(nearest.curve.numbers.begin(), nearest.curve.numbers.end());
  function.error = nearest.error;
}

/// A row of each number; what they share stands in `shared`.
void append_rows(const FunctionDeclaration& function, const ParameterInfo& shared, const Position& position,
                 std::vector<ParameterInfo>& rows) {
  const std::vector<double> places = curve_abscissae(function.numbers.size());
  rows.reserve(rows.size() + places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    ParameterInfo row = shared;
    row.name = fmt::format("{}_{}", function.name, i + 1);
    row.default_value = function.numbers[i];
    if (places.size() > 1)
      row.help = fmt::format("{} at {:.3g}{}{}", function.name, places[i], shared.help.empty() ? "" : ": ",
                             shared.help);
    check_value(row, row.default_value, describe(position));
    rows.push_back(std::move(row));
  }
}

}  // namespace

FunctionDeclaration parse_function_declaration(Cursor& cursor, const std::string& name,
                                               std::vector<ParameterInfo>& rows) {
  FunctionDeclaration function;
  function.name = name;
  cursor.expect("=");
  cursor.skip_space();
  const Position position = cursor.position();
  std::vector<PlanePoint> points;
  if (cursor.rest().starts_with('"'))
    points = read_function_file(function.file = parse_file_name(cursor), position);
  else if (cursor.rest().starts_with('['))
    function.numbers = parse_curve_numbers(cursor);
  else
    cursor.fail("'[' and the numbers of a function, or the name of a .func file in quotes");
  std::optional<ParameterInfo> shared;
  if (!cursor.at_end()) shared = parse_bounds_row(cursor, name);
  if (!function.file.empty()) follow_file(points, shared ? &*shared : nullptr, position, function);
  if (shared) append_rows(function, *shared, position, rows);
  return function;
}

}  // namespace espalier::lsystem
