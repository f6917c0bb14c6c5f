// The silhouette that a fit began with: its best start point, as the fit saw it.
#pragma once
#include <filesystem>

#include <espalier/image/masks/mask.h>

namespace espalier {

/// Grows it again from what the run's directory says. Throws InputError for files that are missing or broken.
Mask draw_best_start(const std::filesystem::path& run_directory);

}  // namespace espalier
