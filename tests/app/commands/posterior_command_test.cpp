// `espalier posterior`: what it prints, and bad input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/posterior_table.h"
#include "support/run_espalier.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The option for the table that other suites take, which is made anew; nothing where none do.
std::string fresh_table_option() {
  const fs::path table = kept_posterior_table();
  fs::remove(table);
  return table.empty() ? "" : " --table '" + table.string() + "'";
}

TEST(PosteriorCommand, PrintsQuantitiesWithIntervals) {
  const std::string out = (fresh_folder("posterior_command") / "run").string();
  fs::create_directory(out);  // as a process that was killed in its first moments leaves it
  std::ofstream(fs::path(out) / "lock") << "";
  std::ofstream(fs::path(out) / ".espalier-0011223344556677.tmp") << "half";
  const std::string picture = std::string(ESPALIER_SOURCE_DIR) + "/targets/fir.png";
  const ProgramRun good = run_espalier("posterior '" + picture + "' --simulations 2000 --height 10 --out " +
                                       out + fresh_table_option());
  ASSERT_EQ(good.exit_code, 0) << good.err;
  for (const char* name :
       {"crown_volume", "leaf_area", "wood_volume", "trunk_radius", "near species: ", "parameters: "})
    EXPECT_THAT(good.out, HasSubstr(name));
  EXPECT_TRUE(fs::exists(out + "/parameters.svg"));
  EXPECT_FALSE(fs::exists(out + "/.espalier-0011223344556677.tmp"));
  const std::string another = std::string(ESPALIER_SOURCE_DIR) + "/targets/oc_palm.png";
  const ProgramRun lost =
      run_espalier("posterior '" + another + "' --simulations 2000 --height 10 --out " + out);
  EXPECT_EQ(lost.exit_code, 2);
  EXPECT_THAT(lost.err, HasSubstr("got the posterior of another picture"));
}

TEST(PosteriorCommand, BadInputIsOneLineAndLeavesNothing) {
  const fs::path folder = fresh_folder("posterior_bad");
  const std::string picture = std::string(ESPALIER_SOURCE_DIR) + "/targets/fir.png",
                    out = (folder / "run").string();
  fs::create_directories(folder / "other" / "mine");
  for (const std::string& arguments :
       {"'" + picture + "' --simulations 100", "'" + picture + "' --height 0",
        "'" + picture + "' --height nan", std::string("nothing.png"),
        "'" + picture + "' --table '" + picture + "'", "'" + picture + "' --samples 0",
        "'" + picture + "' --table '" + (folder / "none" / "t.bin").string() + "'"}) {
    const ProgramRun run = run_espalier("posterior " + arguments + " --out " + out);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_THAT(run.err, testing::MatchesRegex("espalier: [^\n]+\n")) << arguments;
    EXPECT_FALSE(fs::exists(out + "/posterior.json"));
  }
  const ProgramRun taken = run_espalier("posterior '" + picture + "' --out " + (folder / "other").string());
  EXPECT_EQ(taken.exit_code, 2);
  EXPECT_THAT(taken.err, HasSubstr("holds other things"));
}

}  // namespace
}  // namespace espalier
