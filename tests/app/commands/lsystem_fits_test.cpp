// Each bundled L-system is fitted to a picture as it is, without an option that says what is free.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include <espalier/lsystem/files/bundled.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

class LsystemFits : public testing::TestWithParam<std::string> {};

TEST_P(LsystemFits, SearchTheParametersOfTheFile) {
  const fs::path folder = fresh_folder("lsystem_fit_" + GetParam());
  const ProgramRun fit = run_espalier(
      fmt::format("fit '" ESPALIER_SOURCE_DIR
                  "/targets/fir.png' --model {}.lsys --evaluations 2 --size 32 --branch-rounds 0 "
                  "--out '{}'",
                  GetParam(), (folder / "run").string()));
  EXPECT_EQ(fit.exit_code, 0) << fit.err;
  EXPECT_TRUE(fs::exists(folder / "run" / "best.toml"));
}

std::string name_of(const testing::TestParamInfo<std::string>& info) { return info.param; }

INSTANTIATE_TEST_SUITE_P(Bundled, LsystemFits, testing::ValuesIn(lsystem::bundled_names()), name_of);

TEST(LsystemFit, SaysWhereThereIsNothingToSearch) {
  const fs::path folder = fresh_folder("lsystem_fit_nothing");
  std::ofstream(folder / "stick.lsys") << "axiom: FF\n";
  const std::string fit = fmt::format("fit '" ESPALIER_SOURCE_DIR
                                      "/targets/fir.png' --model '{}' --evaluations 2 --size 32 "
                                      "--branch-rounds 0 --out '{}'",
                                      (folder / "stick.lsys").string(), (folder / "run").string());
  const ProgramRun run = run_espalier(fit);
  expect_one_clear_error(run);
  EXPECT_NE(run.err.find("stick.lsys: got a model without parameters to search"), std::string::npos)
      << run.err;
  EXPECT_EQ(run.err.find("--free:"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(folder / "run"));
  EXPECT_EQ(run_espalier(fit + " --free unit").exit_code, 0);
}

}  // namespace
}  // namespace espalier
