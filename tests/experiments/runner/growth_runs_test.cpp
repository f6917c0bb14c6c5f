// Growth of both kinds of trees: whose phases are measured, and which plants they are.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/csv.h>
#include <espalier/experiments/runner/experiment_directory.h>
#include <espalier/experiments/runner/run_experiment.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

fs::path grown(const std::string& text) {
  const fs::path folder = fresh_folder("growth");
  std::ofstream(folder / "growth.toml") << "[growth]\nseeds = 2\n" << text;
  run_experiment(read_experiment(folder / "growth.toml"), folder / "out", {});
  return folder / "out";
}

TEST(GrowthRuns, SpeciesAndLSystemsHaveRowsOfTheirOwnPhases) {
  const fs::path out =
      grown("species = ['palm']\nmodels = ['palm', {model = 'aspen', label = 'quaking_aspen'}]\n");
  const CsvTable results = read_csv(out / "results.csv");
  ASSERT_EQ(results.rows.size(), 3u);
  const char* species[] = {"palm", "palm", "quaking_aspen"};
  const char* models[] = {"weber_penn", "palm.lsys", "aspen.lsys"};
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_EQ(results.text(row, "status"), "done") << results.text(row, "error");
    EXPECT_EQ(results.text(row, "species"), species[row]);
    EXPECT_EQ(results.text(row, "model"), models[row]);
    const CsvTable samples = read_csv(run_directory(out, results.text(row, "run")) / "samples.csv");
    ASSERT_EQ(samples.rows.size(), 2u);
    const bool is_lsystem = row > 0;
    for (std::size_t seed = 0; seed < 2; ++seed) {
      EXPECT_EQ(std::isnan(samples.number(seed, "stem_seconds")), is_lsystem);
      EXPECT_EQ(std::isnan(samples.number(seed, "leaf_seconds")), is_lsystem);
      EXPECT_EQ(samples.number(seed, "derivation_seconds") > 0, is_lsystem);
      EXPECT_EQ(samples.number(seed, "interpretation_seconds") > 0, is_lsystem);
    }
  }
}

TEST(GrowthRuns, LSystemsAloneAreGrownAlone) {
  EXPECT_EQ(read_csv(grown("models = ['palm']\n") / "results.csv").rows.size(), 1u);
}

}  // namespace
}  // namespace espalier
