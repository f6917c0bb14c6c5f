#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/experiments/analysis/finished_fits.h>
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/declaration/target_files.h>
#include <espalier/experiments/export/export_study.h>
#include <espalier/experiments/runner/experiment_directory.h>
#include <espalier/experiments/runner/plan.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

constexpr double kNoLikeness = 1;  ///< of 1 - fitness

/// After so many evaluations: what the last batch reached, and the best so far, as 1 - fitness.
struct ExportedRow {
  long evaluations = 0;
  double current = 0, best = 0;
};

struct ExportedRun {
  std::string instance;  ///< its seed
  std::vector<ExportedRow> rows;
};

/// All seeds of a method on a target.
struct ExportedFunction {
  std::size_t id = 0;  ///< from 1
  std::size_t dimension = 0;
  std::string target, method;
  std::vector<ExportedRun> runs;
};

std::vector<ExportedRow> rows_of(const FinishedFit& fit) {
  std::vector<ExportedRow> rows{{1, kNoLikeness, kNoLikeness}};
  for (const GenerationRow& row : fit.trace) {
    const double best = std::min(rows.back().best, 1 - row.best);
    if (row.evaluations > rows.back().evaluations)
      rows.push_back({row.evaluations, 1 - row.batch_best, best});
    else
      rows.back().best = best;
  }
  return rows;
}

/// How many parameters were searched. Version 0.1 sorted them by how sure it was of each.
std::size_t dimension_of(const fs::path& run) {
  const fs::path path = run / "summary.json";
  const auto summary = nlohmann::json::parse(read_file(path), nullptr, false);
  std::size_t dimension = 0;
  if (summary.is_object() && summary.contains("searched")) dimension = summary["searched"].size();
  if (summary.is_object() && summary.contains("parameters") && summary["parameters"].is_object())
    for (const auto& names : summary["parameters"])
      if (names.is_array()) dimension += names.size();
  if (dimension == 0)
    throw_input_error("{}: got no parameters that were searched, expected their names", path.string());
  return dimension;
}

void check_study(const fs::path& study, const std::vector<FinishedFit>& fits) {
  if (std::ranges::all_of(fits, [](const FinishedFit& fit) { return fit.failed; }))
    throw_input_error("{}: got no finished run, expected at least one (espalier experiment run)",
                      study.string());
  const std::vector<std::string> objectives = in_order(fits, &FinishedFit::objective);
  if (objectives.size() > 1)
    throw_input_error("{}: got the objectives {}, expected one: each would be its own judge", study.string(),
                      fmt::join(objectives, " and "));
}

std::vector<FinishedFit> fits_of(const fs::path& study) {
  const fs::path declaration = study / "experiment.toml";
  std::error_code error;
  if (!fs::is_regular_file(declaration, error))
    throw_input_error("{}: got no experiment.toml in it, expected the directory of an experiment",
                      study.string());
  if (const std::string kind = read_metadata(declaration).kind; kind != "fits")
    throw_input_error("{}: got an experiment of [{}], expected one of [fits]", study.string(), kind);
  std::vector<FinishedFit> fits = read_finished_fits(study);
  check_study(study, fits);
  return fits;
}

std::vector<ExportedFunction> functions_of(const fs::path& study, const std::vector<FinishedFit>& fits) {
  const std::vector<std::string> targets = in_order(fits, &FinishedFit::target);
  std::vector<ExportedFunction> functions;
  for (const std::string& method : in_order(fits, &FinishedFit::method))
    for (std::size_t i = 0; i < targets.size(); ++i) {
      ExportedFunction function{i + 1, 0, targets[i], method, {}};
      for (const FinishedFit& fit : fits) {
        if (fit.failed || fit.method != method || fit.target != targets[i]) continue;
        function.dimension = dimension_of(run_directory(study, fit.run));
        function.runs.push_back({fit.seed, rows_of(fit)});
      }
      if (!function.runs.empty()) functions.push_back(std::move(function));
    }
  return functions;
}

/// Names stand between single quotes.
std::string unquoted(std::string text) {
  std::ranges::replace(text, '\'', ' ');
  return text;
}

/// ", INSTANCE:EVALUATIONS|VALUE" of each run; that of COCO is the distance to what it calls the target.
std::string record_line(const ExportedFunction& function, const std::string& data_file, double target) {
  std::string line = data_file;
  for (const ExportedRun& run : function.runs)
    line += fmt::format(", {}:{}|{:.5e}", run.instance, run.rows.back().evaluations,
                        run.rows.back().best - target);
  return line + "\n";
}

// IOHprofiler.

void write_iohprofiler(const ExportedFunction& function, const fs::path& folder) {
  const std::string data_file =
      fmt::format("data_f{0}/IOHprofiler_f{0}_DIM{1}.dat", function.id, function.dimension);
  std::string data;
  for (const ExportedRun& run : function.runs) {
    data +=
        "\"function evaluation\" \"current f(x)\" \"best-so-far f(x)\" \"current af(x)+b\" \"best "
        "af(x)+b\"\n";
    for (const ExportedRow& row : run.rows)
      data +=
          fmt::format("{0} {1:+.9e} {2:+.9e} {1:+.9e} {2:+.9e}\n", row.evaluations, row.current, row.best);
  }
  fs::create_directories((folder / data_file).parent_path());
  write_file_atomically(folder / data_file, data);
  write_file_atomically(
      folder / fmt::format("IOHprofiler_f{}.info", function.id),
      fmt::format("suite = 'espalier', funcId = {}, funcName = '{}', DIM = {}, maximization = 'F', algId = "
                  "'{}'\n%\n{}",
                  function.id, unquoted(function.target), function.dimension, unquoted(function.method),
                  record_line(function, data_file, 0)));
}

// COCO.

std::string coco_row(const ExportedRow& row) {
  return fmt::format("{} 0 {:+.9e} {:+.9e} {:+.9e}\n", row.evaluations, row.best, row.current, row.best);
}

bool is_better(const ExportedRow& row, const ExportedRow& before) { return row.best < before.best; }

/// By values (.dat): where the best changes, and the last row; by evaluations (.tdat): all rows.
std::string coco_data(const ExportedFunction& function, bool all_rows) {
  std::string data;
  for (const ExportedRun& run : function.runs) {
    data +=
        "% f evaluations | g evaluations | best noise-free fitness - Fopt (0.000000000000e+00) + sum g_i+ | "
        "measured fitness | best measured fitness or single-digit g-values | x1 | x2...\n";
    for (std::size_t i = 0; i < run.rows.size(); ++i)
      if (all_rows || i == 0 || i + 1 == run.rows.size() || is_better(run.rows[i], run.rows[i - 1]))
        data += coco_row(run.rows[i]);
  }
  return data;
}

/// The suite is bbob, since the post-processing knows no others.
void write_coco(const ExportedFunction& function, const fs::path& folder) {
  constexpr double kPrecision = 1e-8;
  const std::string data_name = fmt::format("data_f{0}/bbobexp_f{0}_DIM{1}", function.id, function.dimension);
  fs::create_directories((folder / data_name).parent_path());
  write_file_atomically(folder / (data_name + ".dat"), coco_data(function, false));
  write_file_atomically(folder / (data_name + ".tdat"), coco_data(function, true));
  write_file_atomically(
      folder / fmt::format("bbobexp_f{}.info", function.id),
      fmt::format(
          "suite = 'bbob', funcId = {}, DIM = {}, Precision = {:.3e}, algId = '{}', logger = 'espalier', "
          "data_format = 'bbob-new'\n% {}\n{}",
          function.id, function.dimension, kPrecision, unquoted(function.method), function.target,
          record_line(function, data_name + ".dat", kPrecision)));
}

struct ExportFormat {
  const char* name;
  void (*write)(const ExportedFunction& function, const fs::path& folder);
};

constexpr ExportFormat kFormats[] = {{"iohprofiler", write_iohprofiler}, {"coco", write_coco}};

const ExportFormat& format_by_name(const std::string& name) {
  for (const ExportFormat& format : kFormats)
    if (format.name == name) return format;
  throw_input_error("got '{}', expected a format: {}", name, fmt::join(export_formats(), ", "));
}

void make_empty(const fs::path& out) {
  std::error_code error;
  fs::create_directories(out, error);
  if (error)
    throw_input_error("{}: got '{}', expected a directory that can be made", out.string(), error.message());
  if (!fs::is_empty(out, error))
    throw_input_error("{}: got a directory with files, expected a new one: others would be read with them",
                      out.string());
}

/// Neither .csv nor .txt, which IOHanalyzer takes for data of other formats.
std::string functions_page(const std::vector<std::string>& targets, const std::string& objective) {
  std::string page = fmt::format(
      "# Functions\n\nThe value is 1 - fitness, of the objective {}.\n\n| function | target |\n|--:|---|\n",
      objective);
  for (std::size_t i = 0; i < targets.size(); ++i) page += fmt::format("| {} | {} |\n", i + 1, targets[i]);
  return page;
}

}  // namespace

std::vector<std::string> export_formats() {
  std::vector<std::string> names;
  names.reserve(std::size(kFormats));
  for (const ExportFormat& format : kFormats) names.emplace_back(format.name);
  return names;
}

std::vector<fs::path> export_study(const fs::path& study, const std::string& format, const fs::path& out) {
  const ExportFormat& chosen = format_by_name(format);
  const std::vector<FinishedFit> fits = fits_of(study);
  const std::vector<ExportedFunction> functions = functions_of(study, fits);
  make_empty(out);
  std::map<std::string, fs::path> folders;  // by method; methods whose names are alike get numbers
  std::vector<fs::path> made;
  for (const ExportedFunction& function : functions) {
    fs::path& folder = folders[function.method];
    if (folder.empty()) {
      const fs::path plain = out / directory_name(function.method);
      folder = fs::exists(plain) ? fs::path(fmt::format("{}-{}", plain.string(), made.size() + 1)) : plain;
      fs::create_directories(folder);
      made.push_back(folder);
    }
    chosen.write(function, folder);
  }
  write_file_atomically(out / "functions.md",
                        functions_page(in_order(fits, &FinishedFit::target), fits.front().objective));
  return made;
}

}  // namespace espalier
