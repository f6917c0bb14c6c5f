// The statement "param NAME = value in low .. high …", and plain numbers.
#pragma once
#include <espalier/core/parameter_table.h>
#include <espalier/lsystem/strings/statements.h>

namespace espalier::lsystem {

/// A finite number, not an expression. Throws InputError that expects `what` where there is none.
double parse_number(Cursor& cursor, std::string_view what);

/// param angle = 32 in 10 .. 60 deg "angle of the branch": from the '=' on.
/// Throws InputError where that is not what follows, bounds are reversed, or the value is out of them.
ParameterInfo parse_parameter_row(Cursor& cursor, const std::string& name);

}  // namespace espalier::lsystem
