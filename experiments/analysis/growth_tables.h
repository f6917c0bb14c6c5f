// The tables of an experiment of growth: times, complexity by species, and the exponents of time over size.
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include <espalier/experiments/runner/csv.h>

namespace espalier {

/// Tables by file name: growth_times.csv, growth_complexity.csv, growth_medians.csv, growth_fit.csv and,
/// where L-systems grew, growth_lsystems.csv. Throws InputError for files that are missing or broken.
std::map<std::string, CsvTable> growth_tables(const std::filesystem::path& directory);

}  // namespace espalier
