// Query modules: ?P(x,y,z) gets the turtle's position where it stands in the string, ?H ?U ?L its heading,
// up and left vectors [Topiary §3]. With two parameters they are the coordinates of the front view: x to
// the right and y upwards; with three, those of the world, z upwards. In units of the file.
#pragma once
#include <espalier/lsystem/notation/settings.h>
#include <espalier/lsystem/strings/module_string.h>

namespace espalier::lsystem {

bool has_queries(const SymbolTable& alphabet);

/// Reads `drawn` with the turtle and writes what its query modules see into those of `string`, in order.
/// `drawn` is `string`, or that after interpretation rules, which must leave query modules as they are.
void fill_queries(const ModuleString& drawn, ModuleString& string, const SymbolTable& alphabet,
                  const Settings& settings);

}  // namespace espalier::lsystem
