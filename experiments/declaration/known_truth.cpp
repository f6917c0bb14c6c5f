#include <algorithm>

#include <espalier/core/field_error.h>
#include <espalier/experiments/declaration/known_truth.h>
#include <espalier/fitting/record/start_names.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace {

/// Of a hundred parameters, two others make no other species.
bool are_defaults(const std::string& species) {
  constexpr int kMostOthers = 2;
  const Preset preset = load_preset(species);
  const ParameterValues defaults = model_by_name(preset.model).table().defaults();
  int others = 0;
  for (std::size_t row = 0; row < defaults.size(); ++row) others += preset.values[row] != defaults[row];
  return others <= kMostOthers;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

std::string start_of_model(const std::string& start, const std::string& model) {
  return start == "auto" && model.ends_with(".lsys") ? "defaults" : start;
}

std::string start_beside_truth(const std::string& start, const std::string& species,
                               const std::string& model) {
  if (species.empty()) return start;
  if (model.ends_with(".lsys") && load_preset(species).model != model) return start;
  const StartNames names = parse_start(start);
  const bool is_automatic = names.source == StartSource::bundled;
  if (is_automatic && (contains(names.left_out, species) || !contains(bundled_presets(), species)))
    return start;
  const bool is_truth = names.source == StartSource::defaults && are_defaults(species);
  std::string beside = start_without(start, species);
  if (is_truth || beside.empty())
    throw_field_error("start",
                      "got '{}' for a target that is a {}, expected another start, or exclude_truth = false",
                      start, species);
  return beside;
}

}  // namespace espalier
