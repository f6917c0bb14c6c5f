// A whole L-system file, statement by statement.
#pragma once
#include <memory>
#include <string>

#include <espalier/lsystem/notation/grammar.h>

namespace espalier::lsystem {

/// The grammar of a text and, where it may, of what it includes. Plants of other L-systems are noted, not
/// grown: files/grammar_file.h does that. Throws InputError with file, line, column, got and expected.
Grammar parse_statements(const std::shared_ptr<const Source>& source, const std::string& name,
                         bool may_include);

}  // namespace espalier::lsystem
