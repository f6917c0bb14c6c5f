// The statements of an L-system file about its surroundings: volume, field, sun, shade. The files that they
// name lie in the folder of the L-system file: a file from a stranger must not show what else is on the disk.
#pragma once
#include <string>

#include <espalier/lsystem/notation/grammar.h>
#include <espalier/lsystem/strings/statements.h>

namespace espalier::lsystem {

/// Throws InputError where the text may read no files, or the name has a path.
std::filesystem::path file_beside(const std::string& name, const Source& source);

/// After "volume NAME": = box(0,0,6, 12,12,12)
void parse_volume_declaration(Cursor& cursor, const std::string& name, Grammar& grammar);

/// After "field NAME": = picture("soil.png", x, y, width)
void parse_field_declaration(Cursor& cursor, const std::string& name, Grammar& grammar);

/// After "sun:": the vector towards it. It becomes the constants sun_x, sun_y, sun_z, of length 1.
void parse_sun(Cursor& cursor, Grammar& grammar);

/// After "shade:": names of volumes that keep light away.
void parse_shades(Cursor& cursor, Grammar& grammar);

}  // namespace espalier::lsystem
