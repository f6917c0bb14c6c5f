// All models by name. A model joins here and can then be rendered, fitted, blended and exported.
#pragma once
#include <string>
#include <vector>

#include <espalier/plant/model.h>

namespace espalier {

/// The model with this name ("weber_penn"), or of an L-system file ("fern.lsys"); throws InputError listing
/// the models there are.
const Model& model_by_name(const std::string& name);

std::vector<std::string> model_names();

}  // namespace espalier
