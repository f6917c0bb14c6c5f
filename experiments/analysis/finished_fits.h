// The finished runs of an experiment of fits, as its tables and traces tell of them.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <espalier/experiments/runner/csv.h>
#include <espalier/experiments/statistics/curves.h>

namespace espalier {

/// A row of the trace before the refinement, whose steps are no evaluations.
struct GenerationRow {
  std::string stage;  ///< "starts", "search", …; empty in traces that do not say
  long evaluations = 0;
  double batch_best = 0, best = 0;  ///< fitness
};

struct FinishedFit {
  std::string run, target, method, seed, objective;  ///< method: the optimiser, and what else varies
  bool failed = false;
  double fitness = 0, seconds = 0;         ///< NaN where not known
  std::map<std::string, double> measures;  ///< the columns below; NaN where not known
  std::vector<GenerationRow> trace;
  StepCurve curve;  ///< of the best fitness
};

/// Evaluations of the starts; 0 where the trace does not say.
long evaluations_of_starts(const FinishedFit& fit);

/// Columns of results.csv that methods are compared by, the most telling first: where all runs have one
/// objective, and where each would be its own judge.
inline constexpr const char* kMeasuresOfOneObjective[] = {"unseen_fitness", "fitness"};
inline constexpr const char* kMeasuresInCommon[] = {"unseen_iou", "iou", "tolerant_iou", "outline_iou"};

/// What is compared: the optimiser, with the objective, space and start where these vary too.
std::string method_of(const CsvTable& results, std::size_t row);

/// In the order of results.csv. Throws InputError for files that are missing or broken.
std::vector<FinishedFit> read_finished_fits(const std::filesystem::path& directory);

/// Targets, or methods, in the order in which they appear.
std::vector<std::string> in_order(const std::vector<FinishedFit>& fits, std::string FinishedFit::*column);

}  // namespace espalier
