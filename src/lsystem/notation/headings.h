// Headings of an L-system file, those of other programs among them: what is not known must not be taken for
// the id of a production, which would rewrite the string instead of drawing it.
#pragma once
#include <string_view>

#include <espalier/lsystem/strings/statements.h>

namespace espalier::lsystem {

/// Throws InputError, which names the closest known heading, where the statement at the cursor opens with
/// words and a colon that end their line, or with a heading of cpfg or L-Py. To be called for what is no
/// keyword.
void check_heading(const Cursor& cursor);

/// Throws InputError for a statement that is nothing known: what was found, what was expected, and where it
/// opens with words and a colon, the closest keyword or setting.
[[noreturn]] void fail_unknown(const Cursor& cursor, std::string_view expected);

}  // namespace espalier::lsystem
