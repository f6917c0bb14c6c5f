#include <algorithm>
#include <nlohmann/json.hpp>

#include <espalier/core/data_path.h>
#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/experiments/analysis/draw_report.h>
#include <espalier/experiments/analysis/fit_tables.h>
#include <espalier/experiments/analysis/growth_tables.h>
#include <espalier/experiments/analysis/plant_tables.h>
#include <espalier/experiments/analysis/rank_tables.h>
#include <espalier/experiments/analysis/report.h>
#include <espalier/experiments/analysis/score_sheet.h>
#include <espalier/experiments/analysis/start_picture.h>
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/experiment_directory.h>
#include <espalier/image/pictures/picture.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;
using Tables = std::map<std::string, CsvTable>;

constexpr std::size_t kMostThumbnails = 24;

/// Its name is the directory's.
ExperimentMetadata metadata_in(const fs::path& directory) {
  const fs::path path = directory / "experiment.toml";
  if (!fs::is_regular_file(path))
    throw_input_error("{}: got no experiment.toml in it, expected the directory of an experiment",
                      directory.string());
  ExperimentMetadata words = read_metadata(path);
  words.name = fs::absolute(path).lexically_normal().parent_path().filename();
  return words;
}

void check_done(const fs::path& directory) {
  if (!fs::is_regular_file(directory / "results.csv") || read_csv(directory / "results.csv").rows.empty())
    throw_input_error("{}: got no finished run, expected at least one (espalier experiment run)",
                      directory.string());
}

/// Of ranks_M.csv and its like.
std::string title_by_measure(const std::string& file) {
  constexpr std::pair<std::string_view, std::string_view> kTitles[] = {
      {"ranks_", "Ranks by {}: targets are blocks; methods that share a letter do not differ"},
      {"friedman_", "Friedman's test of {}"},
      {"pairs_",
       "Pairs by {}: the median difference over the targets, its 95 % interval, Wilcoxon's test, Holm's "
       "correction"}};
  for (const auto& [prefix, title] : kTitles)
    if (file.starts_with(prefix)) {
      const std::string measure =
          file.substr(prefix.size(), file.size() - prefix.size() - std::string(".csv").size());
      return fmt::format(fmt::runtime(title), measure);
    }
  return "";
}

std::string title_of(const std::string& file) {
  static const std::map<std::string, std::string> titles{
      {"score_groups.csv", "Score sheet by groups: means of the pictures' means"},
      {"score_sheet.csv", "Score sheet: means over the seeds, the spread of the IoU over them"},
      {"results.csv", "All runs"},
      {"plants.csv", "Plants: wood that shows, depth, leaves, numbers of overrides"},
      {"sides.csv", "The side that no picture shows: fits beside trees of the true parameters"},
      {"growth_fit.csv",
       "Exponents: seconds = factor · size^exponent; the error is of as many independent trees as there are "
       "species"},
      {"growth_lsystems.csv",
       "Exponents within each L-system: seconds of the interpretation over points of the stems' curves"},
      {"growth_medians.csv", "Milliseconds of a tree: the quartiles of the whole, the medians of the phases"},
      {"growth_complexity.csv", "Points of the stems' curves"}};
  const auto found = titles.find(file);
  return found == titles.end() ? title_by_measure(file) : found->second;
}

Json table_list(const Tables& tables) {
  Json list = Json::array();
  for (const auto& [file, table] : tables)
    if (const std::string title = title_of(file); !title.empty())
      list.push_back({{"file", file}, {"title", title}});
  return list;
}

/// All runs of a small experiment; of a large one the best of each target.
std::vector<const FinishedFit*> fits_to_show(const std::vector<FinishedFit>& fits) {
  std::vector<const FinishedFit*> shown;
  for (const FinishedFit& fit : fits)
    if (!fit.failed) shown.push_back(&fit);
  if (shown.size() <= kMostThumbnails) return shown;
  std::map<std::string, const FinishedFit*> best;
  for (const FinishedFit* fit : shown)
    if (const FinishedFit*& known = best[fit->target]; !known || fit->fitness > known->fitness) known = fit;
  shown.clear();
  for (const auto& [target, fit] : best) shown.push_back(fit);
  return shown;
}

/// Pictures of start, target and result; that of the start is drawn into the report.
Json thumbnails_of(const std::vector<FinishedFit>& fits, const fs::path& directory) {
  Json list = Json::array();
  for (const FinishedFit* fit : fits_to_show(fits)) {
    const std::string run = "../runs/" + fit->run, start = fmt::format("start_{}.png", fit->run);
    write_mask_png(directory / "report" / start, draw_best_start(run_directory(directory, fit->run)));
    list.push_back({{"run", fit->run},
                    {"start", start},
                    {"target", run + "/target.png"},
                    {"result", run + "/best.png"},
                    {"overlay", run + "/overlay.png"},
                    {"label", fmt::format("{}: {}, seed {}", fit->target, fit->method, fit->seed)},
                    {"fitness", fit->fitness}});
  }
  return list;
}

std::vector<std::string> distinct(const CsvTable& table, const std::string& column) {
  std::vector<std::string> values;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (std::find(values.begin(), values.end(), table.text(row, column)) == values.end())
      values.push_back(table.text(row, column));
  return values;
}

/// Rows, columns and the picture of each cell; an empty path where it is not drawn.
Json sheet_of(const CsvTable& results) {
  const std::vector<std::string> rows = distinct(results, "row"), columns = distinct(results, "column");
  std::vector<std::vector<std::string>> cells(rows.size(), std::vector<std::string>(columns.size()));
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    const auto row = std::find(rows.begin(), rows.end(), results.text(i, "row")) - rows.begin(),
               column =
                   std::find(columns.begin(), columns.end(), results.text(i, "column")) - columns.begin();
    if (results.text(i, "status") == "done")
      cells[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
          fmt::format("../runs/{}/picture.png", results.text(i, "run"));
  }
  return {{"rows", rows}, {"columns", columns}, {"cells", cells}};
}

/// What fitness measures; empty where runs differ in it.
std::string objective_in(const fs::path& directory) {
  const std::vector<std::string> objectives = distinct(read_csv(directory / "results.csv"), "objective");
  return objectives.size() == 1 ? objectives[0] : "";
}

/// Of a bundled experiment its file; of another one what the page itself shows.
std::string command_of(const ExperimentMetadata& words) {
  const fs::path bundled = data_path_or_first("experiments") / (words.name + ".toml");
  const bool is_bundled = fs::is_regular_file(bundled) && same_runs(read_file(bundled), words.text);
  if (is_bundled) return fmt::format("./espalier experiment run experiments/{}.toml", words.name);
  return fmt::format("espalier experiment run {0}.toml   # the declaration below, saved as {0}.toml",
                     words.name);
}

Json meta_of(const ExperimentMetadata& words, const ReportOptions& options) {
  return {{"name", words.name},           {"kind", words.kind},
          {"title", words.title},         {"figure", words.figure},
          {"published", words.published}, {"published_fitness", words.published_fitness},
          {"found", words.found},         {"note", words.note},
          {"command", command_of(words)}, {"declaration", words.text},
          {"versions", options.versions}};
}

}  // namespace

fs::path write_report(const fs::path& directory, const ReportOptions& options) {
  const ExperimentMetadata words = metadata_in(directory);
  check_done(directory);
  const fs::path report = directory / "report";
  fs::remove_all(report);
  fs::create_directories(report);
  Tables tables;
  Json meta = meta_of(words, options);
  if (words.kind == "fits") {
    const std::vector<FinishedFit> fits = read_finished_fits(directory);
    tables = fit_tables(fits);
    if (const TargetGroups groups = read_groups(directory / "experiment.toml"); !groups.empty()) {
      const ScoreSheet sheet = score_sheet(fits, groups, directory);
      tables.emplace("score_groups.csv", sheet.groups), tables.emplace("score_sheet.csv", sheet.targets);
      meta["score_sheet"] = sheet.pages;
      meta["thumbnails"] = Json::array();
    } else {
      meta["thumbnails"] = thumbnails_of(fits, directory);
    }
    meta["objective"] = objective_in(directory);
    meta["ranked_by"] = ranked_measures(fits);
    const CsvTable results = read_csv(directory / "results.csv");
    for (CsvTable table :
         {plant_table(results, read_groups(directory / "experiment.toml")), side_table(results)})
      if (!table.rows.empty()) tables.emplace(table.source, std::move(table));
  }
  if (words.kind == "growth") tables = growth_tables(directory);
  tables.emplace("results.csv", read_csv(directory / "results.csv"));
  if (words.kind == "pictures") meta["sheet"] = sheet_of(tables.at("results.csv"));
  meta["tables"] = table_list(tables);
  for (const auto& [file, table] : tables) write_file_atomically(report / file, to_csv(table));
  write_file_atomically(report / "meta.json", meta.dump(2) + "\n");
  draw_report(report);
  return report / "index.html";
}

}  // namespace espalier
