// Shaded pictures of the tree that a run of espalier fit left, as a person would look at it to judge the
// plant and not the outline: from the front, from the side, and from in between and a little above.
#pragma once
#include <filesystem>

#include <espalier/image/pictures/picture.h>

namespace espalier {

/// Three squares of size_px in a row. Grown from best.toml, with its seed or that of run.toml. Throws
/// InputError where the files are missing or broken.
Picture draw_fitted_tree(const std::filesystem::path& run_directory, int size_px = 220);

}  // namespace espalier
