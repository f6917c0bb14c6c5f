// What `espalier --version` says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <espalier/app/version.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

TEST(Version, IsPrintedWithTheCommitAndEachLibrary) {
  const ProgramRun run = run_espalier("--version");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, testing::StartsWith("espalier " + program_version() + " (commit " + build_commit()));
  for (const LibraryVersion& library : library_versions())
    EXPECT_THAT(run.out, testing::HasSubstr(library.name + " " + library.version + "\n"));
}

TEST(Version, TheCommitIsTwelveDigitsOrUnknown) {
  EXPECT_THAT(build_commit(), testing::MatchesRegex("unknown|[0-9a-f]{12}(-dirty)?"));
}

}  // namespace
}  // namespace espalier
