// Two finished studies beside each other: is the second better on the targets that both have? A target is a
// block, on which a method has the mean of its seeds; methods are compared by measures that both studies
// have, never by fitness, by which each study may mean something else. Wilcoxon's signed-rank test of the
// differences, Holm's correction for all rows of the table, the median difference with its bootstrap
// interval, and the matched-pairs rank-biserial correlation (Kerby, "The simple difference formula",
// Comprehensive Psychology 3, 2014): 1 where the second is better on all targets, -1 where the first is.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <espalier/experiments/runner/csv.h>

namespace espalier {

struct StudyComparison {
  std::string first, second;            ///< directories, as they were given
  std::vector<std::string> targets;     ///< that both have
  std::vector<std::string> left_out;    ///< targets of one alone
  std::vector<std::string> objectives;  ///< of both, by which they are not compared
  std::vector<std::string> measures;    ///< that all runs of both have
  std::size_t first_seeds = 0, second_seeds = 0;
  CsvTable table;  ///< compare.csv: a row a measure and a pair of methods; positive: the second is better
};

/// Methods that both have are compared by name; where there is none, each with each. A failed run counts as
/// 0. Throws InputError where a directory is no finished study of fits, where no target or no measure is in
/// both, and where a target of one name is another mask.
StudyComparison compare_studies(const std::filesystem::path& first, const std::filesystem::path& second);

/// The page.
std::string comparison_as_markdown(const StudyComparison& comparison);

}  // namespace espalier
