#include <algorithm>
#include <nlohmann/json.hpp>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/experiments/analysis/start_picture.h>
#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/starts/fit_plan.h>
#include <espalier/fitting/task/record_task.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

/// The names of the start points, the best first [summary.json]. The best of a search of the species space
/// stands among them, which no plan holds.
std::vector<std::string> starts_best_first(const fs::path& summary_path) {
  try {
    auto starts = nlohmann::json::parse(read_file(summary_path)).at("starts");
    std::stable_sort(starts.begin(), starts.end(), [](const auto& a, const auto& b) {
      return a.at("fitness").template get<double>() > b.at("fitness").template get<double>();
    });
    std::vector<std::string> names;
    for (const auto& start : starts) names.push_back(start.at("name"));
    return names;
  } catch (const nlohmann::json::exception& error) {
    throw_input_error("{}: got no summary of a run ({}), expected one", summary_path.string(), error.what());
  }
}

}  // namespace

Mask draw_best_start(const fs::path& directory) {
  FitRecord record = read_record(directory / "run.toml").record;
  FitTask task = make_task(record);
  const FitPlan plan = plan_of(record, task);
  settle_branches(plan, task);
  for (const std::string& name : starts_best_first(directory / "summary.json"))
    for (const StartPoint& start : plan.starts)
      if (start.name == name) return draw_candidate(task, start.values, *task.make_renderer()).front();
  throw_input_error("{}: got no start point of the record's in summary.json, expected one",
                    directory.string());
}

}  // namespace espalier
