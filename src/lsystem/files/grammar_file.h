// Grammars from files and texts, ready to derive: parsed, and with the plants grown that they name.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include <espalier/lsystem/notation/grammar.h>

namespace espalier::lsystem {

/// Reads a file and what it includes, and grows the plants that it names. Throws InputError with file, line,
/// column, got and expected.
/// `so_far`, unless null, has what was read for the L-system of which this one is a plant.
Grammar read_grammar(const std::string& path, bool may_have_plants = true,
                     const std::shared_ptr<ReadSoFar>& so_far = nullptr);

/// Reads an L-system from text; messages call it `label`. Includes are refused; so are meshes and pictures
/// without a folder.
Grammar parse_grammar(const std::string& text, const std::string& label,
                      const std::filesystem::path& folder = {});

}  // namespace espalier::lsystem
