// All models by name. A model joins here and can then be rendered, fitted, blended and exported.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <espalier/plant/model.h>

namespace espalier {

/// The model with this name ("weber_penn"), or of an L-system file ("fern.lsys"); throws InputError listing
/// the models there are.
const Model& model_by_name(const std::string& name);

std::vector<std::string> model_names();

/// The name of a model as a file in `folder` says it: an L-system file is looked for from there on first.
std::string model_from(const std::filesystem::path& folder, const std::string& name);

/// Whether two names are of one model: an L-system file may have two paths.
bool is_same_model(const std::string& a, const std::string& b);

}  // namespace espalier
