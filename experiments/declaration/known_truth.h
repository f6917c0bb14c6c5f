// Fits of known trees: where the answer is not to be among the starts.
#pragma once
#include <string>

namespace espalier {

/// The start of a fit whose target is a tree of this species, without that species: "auto" becomes
/// "auto,-acer". A picture's target (no species) keeps its start, as does a species that is a file of its
/// own. Throws FieldError ("start") where nothing else is left, or where the start is the table's defaults
/// and these are the species.
std::string start_beside_truth(const std::string& start, const std::string& species);

}  // namespace espalier
