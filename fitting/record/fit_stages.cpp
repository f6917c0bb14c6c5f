#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <sstream>

#include <espalier/core/field_error.h>
#include <espalier/fitting/record/fit_stages.h>

namespace espalier {

namespace {

struct ChosenStage {
  FitStage stage;
  bool FitStages::*runs;
};
constexpr std::array<ChosenStage, 4> kStages{{{FitStage::search, &FitStages::search},
                                              {FitStage::tracing, &FitStages::tracing},
                                              {FitStage::branches, &FitStages::branches},
                                              {FitStage::finish, &FitStages::finish}}};

}  // namespace

std::string to_string(const FitStages& stages) {
  std::vector<std::string> names;
  for (const ChosenStage& chosen : kStages)
    if (stages.*chosen.runs) names.push_back(name_of(chosen.stage));
  return names.empty() ? name_of(FitStage::starts) : fmt::format("{}", fmt::join(names, ","));
}

FitStages parse_stages(const std::string& text) {
  FitStages stages{false, false, false, false};
  if (text == name_of(FitStage::starts)) return stages;
  std::stringstream stream(text);
  std::string name;
  while (std::getline(stream, name, ',')) {
    const auto found = std::find_if(kStages.begin(), kStages.end(),
                                    [&](const ChosenStage& chosen) { return name_of(chosen.stage) == name; });
    if (found == kStages.end())
      throw_field_error("stages", "got '{}', expected names of: starts, {}", name, to_string(FitStages{}));
    stages.*found->runs = true;
  }
  if (stages == FitStages{false, false, false, false})
    throw_field_error("stages", "got nothing, expected names of: starts, {}", to_string(FitStages{}));
  return stages;
}

}  // namespace espalier
