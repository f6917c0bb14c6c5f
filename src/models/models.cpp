#include <map>
#include <memory>
#include <mutex>

#include <espalier/core/error.h>
#include <espalier/lsystem/files/model.h>
#include <espalier/models/models.h>
#include <espalier/weber_penn/model.h>

namespace espalier {

namespace {

using ModelFunction = const Model& (*)();
constexpr ModelFunction kModels[] = {weber_penn_model};

/// Each is read once and lives as long as the program.
const Model& lsystem_model(const std::string& name) {
  static std::mutex mutex;
  static std::map<std::string, std::unique_ptr<Model>> models;
  const std::lock_guard lock(mutex);
  std::unique_ptr<Model>& model = models[name];
  if (!model) model = lsystem::make_model(name);
  return *model;
}

}  // namespace

const Model& model_by_name(const std::string& name) {
  if (name.ends_with(".lsys")) return lsystem_model(name);
  for (const ModelFunction model : kModels)
    if (model().table().model == name) return model();
  const std::vector<std::string> known = model_names();
  throw_input_error("got model '{}', expected an .lsys file or one of: {}", name, fmt::join(known, ", "));
}

std::string model_from(const std::filesystem::path& folder, const std::string& name) {
  if (!name.ends_with(".lsys")) return name;
  const std::filesystem::path path = (folder / name).lexically_normal();
  std::error_code none;
  return std::filesystem::is_regular_file(path, none) ? path.string() : name;
}

bool is_same_model(const std::string& a, const std::string& b) {
  std::error_code none;
  return a == b || (a.ends_with(".lsys") && b.ends_with(".lsys") && std::filesystem::equivalent(a, b, none));
}

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const ModelFunction model : kModels) names.push_back(model().table().model);
  return names;
}

}  // namespace espalier
