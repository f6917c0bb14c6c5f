// The table that ends an experiment, as text for a terminal.
#pragma once
#include <string>

#include <espalier/experiments/runner/run_experiment.h>

namespace espalier {

/// A line a run; of more than kMostLines runs of fits a line an optimiser, with medians, and one a failed
/// run.
std::string summary_table(const ExperimentOutcome& outcome);

}  // namespace espalier
