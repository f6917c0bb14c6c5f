#include <algorithm>
#include <cmath>
#include <map>

#include <espalier/experiments/analysis/finished_fits.h>
#include <espalier/experiments/runner/experiment_directory.h>
#include <espalier/fitting/record/fit_stages.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

bool varies(const CsvTable& results, const std::string& column) {
  for (std::size_t i = 1; i < results.rows.size() && results.has(column); ++i)
    if (results.text(i, column) != results.text(0, column)) return true;
  return false;
}

bool is_refinement(const std::string& stage) {
  return stage == name_of(FitStage::tracing) || stage == name_of(FitStage::branches) ||
         stage == name_of(FitStage::finish);
}

/// Without the refinement: in its rows traces of 0.1 have branch steps among the evaluations.
std::vector<GenerationRow> read_trace(const fs::path& path) {
  const CsvTable trace = read_csv(path);
  std::vector<GenerationRow> rows;
  for (std::size_t i = 0; i < trace.rows.size(); ++i) {
    const std::string stage = trace.has("stage") ? trace.text(i, "stage") : "";
    if (is_refinement(stage)) break;
    rows.push_back({stage, std::lround(trace.number(i, "evaluations")), trace.number(i, "batch_best"),
                    trace.number(i, "best")});
  }
  return rows;
}

/// The best so far.
StepCurve curve_of(const std::vector<GenerationRow>& trace) {
  StepCurve curve;
  for (const GenerationRow& row : trace) {
    const double best = curve.best.empty() ? row.best : std::max(curve.best.back(), row.best);
    if (!curve.evaluations.empty() && curve.evaluations.back() == row.evaluations)
      curve.best.back() = best;
    else
      curve.evaluations.push_back(row.evaluations), curve.best.push_back(best);
  }
  return curve;
}

std::map<std::string, double> read_seconds(const fs::path& path) {
  const CsvTable times = read_csv(path);
  std::map<std::string, double> seconds;
  for (std::size_t i = 0; i < times.rows.size(); ++i)
    seconds[times.text(i, "run")] = times.number(i, "seconds");
  return seconds;
}

FinishedFit read_fit(const CsvTable& results, std::size_t row, const fs::path& directory) {
  FinishedFit fit{results.text(row, "run"),       results.text(row, "target"),
                  method_of(results, row),        results.text(row, "seed"),
                  results.text(row, "objective"), results.text(row, "status") == "failed"};
  fit.fitness = results.number(row, "fitness");
  for (const char* measure : kMeasuresOfOneObjective) fit.measures[measure] = results.number(row, measure);
  for (const char* measure : kMeasuresInCommon) fit.measures[measure] = results.number(row, measure);
  if (fit.failed) return fit;
  fit.trace = read_trace(run_directory(directory, fit.run) / "trace.csv");
  fit.curve = curve_of(fit.trace);
  return fit;
}

}  // namespace

std::string method_of(const CsvTable& results, std::size_t row) {
  std::string method;
  for (const char* column : {"optimizer", "objective", "space", "start", "trained"})
    if (varies(results, column)) method.append(method.empty() ? "" : ", ").append(results.text(row, column));
  return method.empty() ? results.text(row, "optimizer") : method;
}

long evaluations_of_starts(const FinishedFit& fit) {
  long evaluations = 0;
  for (const GenerationRow& row : fit.trace)
    if (row.stage == name_of(FitStage::starts)) evaluations = row.evaluations;
  return evaluations;
}

std::vector<FinishedFit> read_finished_fits(const fs::path& directory) {
  const CsvTable results = read_csv(directory / "results.csv");
  const auto seconds = read_seconds(directory / "times.csv");
  std::vector<FinishedFit> fits;
  for (std::size_t row = 0; row < results.rows.size(); ++row) {
    fits.push_back(read_fit(results, row, directory));
    const auto known = seconds.find(fits.back().run);
    fits.back().seconds = known == seconds.end() ? NAN : known->second;
  }
  return fits;
}

std::vector<std::string> in_order(const std::vector<FinishedFit>& fits, std::string FinishedFit::*column) {
  std::vector<std::string> names;
  for (const FinishedFit& fit : fits)
    if (std::find(names.begin(), names.end(), fit.*column) == names.end()) names.push_back(fit.*column);
  return names;
}

}  // namespace espalier
