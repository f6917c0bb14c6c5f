#include "models/models.h"

#include "core/error.h"
#include "weber_penn/model.h"

namespace espalier {

namespace {

using ModelFunction = const Model& (*)();
constexpr ModelFunction kModels[] = {weber_penn_model};

}  // namespace

const Model& model_by_name(const std::string& name) {
  for (const ModelFunction model : kModels)
    if (model().table().model == name) return model();
  const std::vector<std::string> known = model_names();
  throw_input_error("got model '{}', expected one of: {}", name, fmt::join(known, ", "));
}

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const ModelFunction model : kModels) names.push_back(model().table().model);
  return names;
}

}  // namespace espalier
