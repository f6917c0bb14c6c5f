// The text that asks a fit to search the species space first.
#pragma once
#include <string>

#include <espalier/fitting/record/species_components.h>

namespace espalier {

/// The number of components that "species:2" asks for; 0 for the empty text. Throws InputError for anything
/// else.
int parse_search_space(const std::string& text);

}  // namespace espalier
