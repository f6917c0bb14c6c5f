// The patches of bundled L-systems (src/lsystem/models/*.patch), built into the program.
#pragma once
#include <span>

#include <espalier/core/embedded_file.h>

namespace espalier {

/// All of them, sorted by name.
std::span<const EmbeddedFile> embedded_surfaces();

}  // namespace espalier
