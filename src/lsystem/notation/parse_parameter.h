// The statement "param NAME = value in low .. high …", and plain numbers.
#pragma once
#include <espalier/core/parameter_table.h>
#include <espalier/lsystem/strings/statements.h>

namespace espalier::lsystem {

/// A finite number, not an expression. Throws InputError that expects `what` where there is none.
double parse_number(Cursor& cursor, std::string_view what);

/// param angle = 32 in 10 .. 60 deg "angle of the branch": from the '=' on; also
/// param leaves = 12 in 1 .. 40 integer role leaf_count, param sway = 9 in 0 .. 30 deg plain 0.
/// Throws InputError where that is not what follows, bounds are reversed, a value is out of them, or the role
/// is unknown.
ParameterInfo parse_parameter_row(Cursor& cursor, const std::string& name);

/// The same without a value, of which `name` is said: from "in" on; its default is the middle of the bounds.
ParameterInfo parse_bounds_row(Cursor& cursor, const std::string& name);

/// Throws InputError, pointing to `position`, where another row bears the role of `row` already, or the unit
/// of the L-system will; only trunk_form is borne by several.
void check_role_is_free(const ParameterTable& table, const ParameterInfo& row, const Position& position);

}  // namespace espalier::lsystem
