// Where the fits of an experiment begin: what `auto` means to a model, and fits of known trees, where the
// answer is not to be among the starts.
#pragma once
#include <string>

namespace espalier {

/// "auto" is what espalier fit begins with: the presets of the parametric model, the defaults of an L-system.
std::string start_of_model(const std::string& start, const std::string& model);

/// The start of a fit whose target is a tree of this species, without that species: "auto" becomes
/// "auto,-acer". A picture's target (no species) keeps its start, as does a species that is a file of its
/// own, and a fit of another model than the species'. Throws FieldError ("start") where nothing else is left,
/// or where the start is the table's defaults and these are the species.
std::string start_beside_truth(const std::string& start, const std::string& species,
                               const std::string& model);

}  // namespace espalier
