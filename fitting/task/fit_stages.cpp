#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <sstream>

#include <espalier/core/error.h>
#include <espalier/fitting/task/fit_stages.h>

namespace espalier {

namespace {

struct NamedStage {
  const char* name;
  bool FitStages::*runs;
};
constexpr std::array<NamedStage, 4> kStages{{{"search", &FitStages::search},
                                             {"tracing", &FitStages::tracing},
                                             {"branches", &FitStages::branches},
                                             {"finish", &FitStages::finish}}};
constexpr const char* kNoStage = "starts";

}  // namespace

std::string to_string(const FitStages& stages) {
  std::vector<std::string> names;
  for (const NamedStage& stage : kStages)
    if (stages.*stage.runs) names.emplace_back(stage.name);
  return names.empty() ? kNoStage : fmt::format("{}", fmt::join(names, ","));
}

FitStages parse_stages(const std::string& text) {
  FitStages stages{false, false, false, false};
  if (text == kNoStage) return stages;
  std::stringstream stream(text);
  std::string name;
  while (std::getline(stream, name, ',')) {
    const auto found = std::find_if(kStages.begin(), kStages.end(),
                                    [&](const NamedStage& stage) { return stage.name == name; });
    if (found == kStages.end())
      throw_input_error("--stages: got '{}', expected names of: starts, {}", name, to_string(FitStages{}));
    stages.*found->runs = true;
  }
  if (to_string(stages) == kNoStage)
    throw_input_error("--stages: got nothing, expected names of: starts, {}", to_string(FitStages{}));
  return stages;
}

}  // namespace espalier
