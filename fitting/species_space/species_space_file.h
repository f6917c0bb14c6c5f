// A species space as TOML: presets, encoding, and what the principal components are made of, to the last bit.
#pragma once
#include <filesystem>
#include <string>

#include <espalier/fitting/species_space/species_space.h>

namespace espalier {

std::string species_space_to_toml(const SpeciesSpace& space);

/// Throws InputError (file, line, key, got, expected) for what is no such file, or was written for another
/// table of parameters.
SpeciesSpace read_species_space(const std::filesystem::path& path);

}  // namespace espalier
