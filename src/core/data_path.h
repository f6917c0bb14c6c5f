// The data that comes with Espalier and is read while it runs: pictures to fit (targets), experiments, the
// program that draws reports, meshes of bundled L-systems. Presets and L-systems themselves are built in.
#pragma once
#include <filesystem>
#include <string>

namespace espalier {

/// Where "targets", "experiments" or "lsystem/models/crown.obj" is. Looked for in the folder that the
/// environment variable ESPALIER_DATA_DIR names; in share/espalier beside the program's folder; where
/// Espalier was installed; in its source. Throws InputError, which says where it looked.
std::filesystem::path data_path(const std::string& name);

/// The same, or where it was looked for first: for data that may never be read.
std::filesystem::path data_path_or_first(const std::string& name);

}  // namespace espalier
