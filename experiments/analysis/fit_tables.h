// The tables of an experiment of fits: convergence, data profiles, ranks with their tests [rank_tables.h],
// and fitness by generation. What is compared is called the optimiser in them.
#pragma once
#include <map>
#include <string>
#include <vector>

#include <espalier/experiments/analysis/finished_fits.h>
#include <espalier/experiments/runner/csv.h>

namespace espalier {

/// Tables by file name: convergence.csv and data_profile.csv (where all runs have one objective), those of
/// rank_tables, generations.csv (of up to 40 runs).
std::map<std::string, CsvTable> fit_tables(const std::vector<FinishedFit>& fits);

}  // namespace espalier
