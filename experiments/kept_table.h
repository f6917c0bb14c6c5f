// Plants of a prior in a file, from one call of a program to the next.
#pragma once
#include <filesystem>

#include <espalier/fitting/posterior/simulations/reference_table.h>

namespace espalier {

/// At least `size` plants; those that the file lacks are drawn, told on stderr and added to it. Throws
/// InputError for a file of another prior, seed or height.
ReferenceTable kept_table(const std::filesystem::path& path, const PlantPrior& prior, Seed seed,
                          double height_m, std::size_t size);

}  // namespace espalier
