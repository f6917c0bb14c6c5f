// The statement "function f = [0, 0.2, 1, 1] in 0 .. 1 …" or "function f = "bend.func" …": a function of one
// variable by a few numbers, which are parameters where their bounds are given.
#pragma once
#include <espalier/lsystem/notation/grammar.h>
#include <espalier/lsystem/strings/statements.h>

namespace espalier::lsystem {

/// After "function NAME": = [numbers], 1, 4, 5 or 7 of them, or = "file.func" in the folder of the L-system,
/// to which 7 numbers are fitted. With "in low .. high" each of them is a row of `rows`, f_1, f_2, …: the
/// numbers stand at the places of curve_abscissae, and the function lies within their bounds. Throws
/// InputError for other counts, numbers that are not finite or out of bounds, and files that are no function
/// of vlab.
FunctionDeclaration parse_function_declaration(Cursor& cursor, const std::string& name,
                                               std::vector<ParameterInfo>& rows);

}  // namespace espalier::lsystem
