// The L-systems that come with the program (src/lsystem/models/*.lsys), by name, and those of the user, by
// path.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/core/embedded_file.h>
#include <espalier/lsystem/notation/grammar.h>

namespace espalier {

/// The bundled L-systems, sorted by name.
std::span<const EmbeddedFile> embedded_lsystems();

}  // namespace espalier

namespace espalier::lsystem {

std::vector<std::string> bundled_names();

/// What a bundled L-system is: the first sentence of the comment that its file opens with. Throws InputError
/// for an unknown name.
std::string bundled_description(std::string_view name);

/// An L-system by path, or a bundled one by name, with or without ".lsys". Throws InputError where there is
/// neither, or it is no L-system.
Grammar load_grammar(const std::string& name_or_path);

}  // namespace espalier::lsystem
