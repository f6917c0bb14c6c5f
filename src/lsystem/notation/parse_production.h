// One production: id: left < predecessor > right : condition --> successor : probability [Topiary §2].
#pragma once
#include <espalier/lsystem/notation/grammar.h>
#include <espalier/lsystem/strings/statements.h>

namespace espalier::lsystem {

/// Reads a statement with an arrow; without an id it is called "production `number`".
/// Throws InputError with the place, what was found and what was expected.
Production parse_production(Cursor& cursor, Grammar& grammar, std::size_t number);

/// Lua code that starts at an offset of the cursor's file, after as many line breaks as the file has before
/// it: Lua then counts lines as the file does. Throws InputError where the grammar has too many of them.
std::string lua_code(const Cursor& cursor, std::size_t begin, std::string_view code, Grammar& grammar);

}  // namespace espalier::lsystem
