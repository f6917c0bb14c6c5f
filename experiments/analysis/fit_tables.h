// The tables of an experiment of fits: convergence, data profiles, ranks with their test, and fitness by
// generation. What is compared is called the optimiser in them.
#pragma once
#include <map>
#include <string>
#include <vector>

#include <espalier/experiments/analysis/finished_fits.h>
#include <espalier/experiments/runner/csv.h>

namespace espalier {

/// Tables by file name: convergence.csv, data_profile.csv, ranks.csv, friedman.csv (these where at least two
/// methods are compared), generations.csv (of up to 40 runs).
std::map<std::string, CsvTable> fit_tables(const std::vector<FinishedFit>& fits);

}  // namespace espalier
