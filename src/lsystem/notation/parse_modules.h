// Modules in the text of a production: patterns, whose parameters are names, and successors, whose
// arguments are Lua expressions.
#pragma once
#include <espalier/lsystem/notation/grammar.h>
#include <espalier/lsystem/strings/statements.h>

namespace espalier::lsystem {

/// Modules up to one of '<', '>', ':', "-->" or the end; blanks between them mean nothing.
std::vector<PatternModule> parse_pattern(Cursor& cursor, Grammar& grammar);

/// Modules up to ':' or the end; "*" and "ε" stand for none.
std::vector<SuccessorModule> parse_successor(Cursor& cursor, Grammar& grammar);

/// Expressions between commas, up to one of `stops`.
std::vector<Expression> parse_expressions(Cursor& cursor, std::string_view stops);

/// One expression, up to one of `stops`; throws where it is empty.
Expression parse_expression(Cursor& cursor, std::string_view stops);

}  // namespace espalier::lsystem
