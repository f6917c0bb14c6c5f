// Which methods are better: ranks with Friedman's test, and for few methods each pair of them. A block is a
// target; what a method reached on it is the mean over the seeds, which share the target and are no further
// data sets.
#pragma once
#include <map>
#include <string>
#include <vector>

#include <espalier/experiments/analysis/finished_fits.h>
#include <espalier/experiments/runner/csv.h>

namespace espalier {

/// The measures that methods are compared by, the most telling first: fitness of the result with seeds that
/// no search saw, then fitness. Where objectives differ, each would be its own judge: measures that all have
/// in common.
std::vector<std::string> ranked_measures(const std::vector<FinishedFit>& fits);

/// Tables by file name, for each measure M: ranks_M.csv, friedman_M.csv (of at least two targets), and
/// pairs_M.csv (of at most six methods). None where fewer than two methods have run on all seeds of a target.
std::map<std::string, CsvTable> rank_tables(const std::vector<FinishedFit>& fits);

}  // namespace espalier
