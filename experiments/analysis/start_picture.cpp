#include <algorithm>
#include <nlohmann/json.hpp>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/experiments/analysis/start_picture.h>
#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/starts/start_points.h>
#include <espalier/fitting/task/record_task.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

/// The name of the start point that scored best [summary.json].
std::string best_start_name(const fs::path& summary_path) {
  try {
    const auto starts = nlohmann::json::parse(read_file(summary_path)).at("starts");
    const auto best = std::max_element(starts.begin(), starts.end(), [](const auto& a, const auto& b) {
      return a.at("fitness").template get<double>() < b.at("fitness").template get<double>();
    });
    if (best != starts.end()) return best->at("name");
  } catch (const nlohmann::json::exception& error) {
    throw_input_error("{}: got no summary of a run ({}), expected one", summary_path.string(), error.what());
  }
  throw_input_error("{}: got no start points, expected some", summary_path.string());
}

}  // namespace

Mask draw_best_start(const fs::path& directory) {
  FitRecord record = read_record(directory / "run.toml").record;
  const std::string name = best_start_name(directory / "summary.json");
  const FitTask task = make_task(record);
  for (const StartPoint& start : make_start_points(*task.model, record.start, record.search, record.growth,
                                                   target_height_m(record), task.plant_seeds.front()))
    if (start.name == name) return draw_candidate(task, start.values, *task.make_renderer()).front();
  throw_input_error("{}: got a start point '{}' that is none of the record's, expected one",
                    directory.string(), name);
}

}  // namespace espalier
