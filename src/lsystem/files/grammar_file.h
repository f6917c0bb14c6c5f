// Grammars from files and texts, ready to derive: parsed, and with the plants grown that they name.
#pragma once
#include <filesystem>
#include <string>

#include <espalier/lsystem/notation/grammar.h>

namespace espalier::lsystem {

/// Reads a file and what it includes, and grows the plants that it names. Throws InputError with file, line,
/// column, got and expected.
Grammar read_grammar(const std::string& path, bool may_have_plants = true);

/// Reads an L-system from text; messages call it `label`. Includes are refused; so are meshes and pictures
/// without a folder.
Grammar parse_grammar(const std::string& text, const std::string& label,
                      const std::filesystem::path& folder = {});

}  // namespace espalier::lsystem
