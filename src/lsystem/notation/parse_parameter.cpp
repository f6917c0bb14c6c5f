#include <cmath>
#include <cstdlib>

#include <espalier/lsystem/notation/parse_parameter.h>

namespace espalier::lsystem {

namespace {

/// leaf_count, or branch_count[2].
void parse_role(Cursor& cursor, ParameterInfo& row) {
  cursor.skip_space();
  const Position position = cursor.position();
  std::string name = cursor.expect_word("a role");
  if (cursor.take("[")) {
    const double level = parse_number(cursor, "a level of branching");
    cursor.expect("]");
    name += fmt::format("[{}]", level);
  }
  try {
    row.role = role_by_name(name);
  } catch (const InputError& error) {
    throw_at(position, "{}", error.what());
  }
}

void parse_plain(Cursor& cursor, ParameterInfo& row) {
  cursor.skip_space();
  const Position position = cursor.position();
  row.plain = parse_number(cursor, "a number");
  check_value(row, *row.plain, describe(position) + ": plain");
}

/// What stands between the bounds and the help, word by word.
void parse_traits(Cursor& cursor, ParameterInfo& row) {
  row.unit.assign(1, '1');
  while (!cursor.at_end() && cursor.rest()[0] != '"') {
    const Position position = cursor.position();
    const std::string word = cursor.expect_word("integer, logarithmic, deg, role, plain or \"help\"");
    if (word == "integer")
      row.scale = Scale::integer;
    else if (word == "logarithmic")
      row.scale = Scale::logarithmic;
    else if (word == "deg")
      row.unit = word;
    else if (word == "role")
      parse_role(cursor, row);
    else if (word == "plain")
      parse_plain(cursor, row);
    else
      throw_at(position, "got '{}', expected integer, logarithmic, deg, role or plain", word);
  }
  if (row.scale == Scale::logarithmic && row.lower <= 0)
    throw_at(cursor.position(), "got lower bound {}, expected one above 0 for a logarithmic parameter",
             row.lower);
}

void parse_help(Cursor& cursor, ParameterInfo& row) {
  if (!cursor.take("\"")) return;
  const std::size_t end = cursor.rest().find('"');
  if (end == std::string_view::npos) cursor.fail("'\"' after the help");
  row.help = std::string(cursor.rest().substr(0, end));
  cursor.go_to(cursor.at() + end + 1);
  if (!cursor.at_end()) cursor.fail("the end of the line");
}

}  // namespace

double parse_number(Cursor& cursor, std::string_view what) {
  cursor.skip_space();
  const std::string text(cursor.rest().substr(0, 40));
  char* stop = nullptr;
  const double value = std::strtod(text.c_str(), &stop);
  // "0..1": the range's dots are none of the number's.
  std::size_t length = static_cast<std::size_t>(stop - text.c_str());
  if (length > 0 && text[length - 1] == '.' && text[length] == '.') --length;
  if (length == 0 || !std::isfinite(value)) cursor.fail(what);
  cursor.go_to(cursor.at() + length);
  return value;
}

ParameterInfo parse_bounds_row(Cursor& cursor, const std::string& name) {
  ParameterInfo row;
  row.name = name;
  const Position position = cursor.position();
  cursor.expect("in");
  row.lower = row.search_lower = parse_number(cursor, "the lower bound");
  cursor.expect("..");
  row.upper = row.search_upper = parse_number(cursor, "the upper bound");
  parse_traits(cursor, row);
  parse_help(cursor, row);
  row.free_by_default = true;
  if (!(row.lower < row.upper))
    throw_at(position, "got bounds {} .. {}, expected the lower one first", row.lower, row.upper);
  row.default_value = (row.lower + row.upper) / 2;
  return row;
}

ParameterInfo parse_parameter_row(Cursor& cursor, const std::string& name) {
  cursor.expect("=");
  const Position position = cursor.position();
  const double value = parse_number(cursor, "a number");
  ParameterInfo row = parse_bounds_row(cursor, name);
  row.default_value = value;
  check_value(row, value, describe(position));
  return row;
}

void check_role_is_free(const ParameterTable& table, const ParameterInfo& row, const Position& position) {
  const auto [role, level] = row.role;
  if (role == Role::none || role == Role::trunk_form) return;
  const auto other = table.find(role, level);
  if (other || role == Role::length_unit)
    throw_at(position, "got role '{}' for '{}', expected one that '{}' does not bear", role_name(row.role),
             row.name, other ? table.rows[*other].name : "unit");
}

}  // namespace espalier::lsystem
