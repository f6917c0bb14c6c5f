// A shaded picture of the tree that a run of espalier fit left, as a person would look at it to judge the
// plant and not the outline: from 45 degrees aside, a little above.
#pragma once
#include <filesystem>

#include <espalier/image/pictures/picture.h>

namespace espalier {

/// Grown from best.toml with the seed of run.toml. Throws InputError where the files are missing or broken.
Picture draw_fitted_tree(const std::filesystem::path& run_directory, int size_px = 220);

}  // namespace espalier
