// How the command line says what C++ calls a field: "--fit-seeds" for "fit_seeds", "--fix" for
// "search.fixed".
#pragma once
#include <string>

namespace espalier {

/// Of an option of a fit as its row says; of any other field its name with dashes.
std::string option_of(const std::string& field);

}  // namespace espalier
