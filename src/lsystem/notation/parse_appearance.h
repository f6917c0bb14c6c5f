// The statements of an L-system file about how its strings look: colors, surface, plant.
#pragma once
#include <string>

#include <espalier/lsystem/strings/statements.h>
#include <espalier/lsystem/surfaces/appearance.h>

namespace espalier::lsystem {

/// A name in quotes, of a file; without control characters, as messages quote it.
std::string parse_file_name(Cursor& cursor);

/// After "colors:": 8b5a2b 2e7d32 …
void parse_color_table(Cursor& cursor, Appearance& appearance);

/// surface petal = "petal.patch"
void parse_surface_declaration(Cursor& cursor, bool may_read_files, Appearance& appearance);

/// After "plant ": hedge = "hedge.lsys" length=8 seed=2: another L-system of the folder, which is noted here
/// and grown by files/. Throws InputError in a file that is such a plant itself, and for too many of them.
void parse_plant_declaration(Cursor& cursor, Appearance& appearance);

}  // namespace espalier::lsystem
