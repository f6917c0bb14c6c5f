// A table of plants for tests of posteriors: 2,000 of them take longer than all that is tested with them.
// ctest names a file in ESPALIER_POSTERIOR_TABLE (tests/CMakeLists.txt), which the test of the command makes
// anew, before the other suites take it. Where a program runs alone, nothing is named, and it makes its own.
#pragma once
#include <cstdlib>
#include <filesystem>

#include <espalier/fitting/posterior/simulations/reference_table.h>

namespace espalier {

/// Of seed 1 and 10 m; empty where none is named.
inline std::filesystem::path kept_posterior_table() {
  const char* path = std::getenv("ESPALIER_POSTERIOR_TABLE");
  return path ? path : "";
}

inline ReferenceTable first_rows(const ReferenceTable& table, std::size_t rows) {
  const auto count = static_cast<Eigen::Index>(rows);
  return {.seed = table.seed,
          .height_m = table.height_m,
          .unknowns = table.unknowns.topRows(count),
          .summaries = table.summaries.topRows(count),
          .species = {table.species.begin(), table.species.begin() + count},
          .attempt = {table.attempt.begin(), table.attempt.begin() + count}};
}

/// Writes its first rows to `path`; nothing where there is none.
inline void take_kept_table(const PlantPrior& prior, std::size_t rows, const std::filesystem::path& path) {
  if (kept_posterior_table().empty()) return;
  write_table(path, prior, first_rows(read_table(kept_posterior_table(), prior, 1, 10), rows));
}

}  // namespace espalier
