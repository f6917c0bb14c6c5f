// The tables of the docs are what the program prints: every block between marks, in every page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include <espalier/fitting/record/fit_options.h>
#include <espalier/image/measures/metric_table.h>
#include <espalier/lsystem/strings/turtle_commands.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

using testing::HasSubstr;

TEST(ReferenceCommand, TheTablesOfTheDocsAreWhatItPrints) {
  const ProgramRun run =
      run_shell("'" ESPALIER_SOURCE_DIR "/docs/update_tables.py' --check '" ESPALIER_PROGRAM "'");
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
}

TEST(ReferenceCommand, HasALineForEachMeasure) {
  const ProgramRun run = run_espalier("reference measures");
  for (const Metric& metric : kMetrics)
    EXPECT_THAT(run.out, HasSubstr(std::string("| `") + metric.name + "` |"));
  EXPECT_THAT(read_text_file(ESPALIER_SOURCE_DIR "/docs/measures.md"), HasSubstr(run.out));
}

/// Help is broken into lines of a hundred columns.
std::string in_one_line(const std::string& text) { return std::regex_replace(text, std::regex("\\s+"), " "); }

TEST(ReferenceCommand, HasALineForEachCommandOfTheTurtle) {
  const ProgramRun run = run_espalier("reference lsystem-commands");
  const std::string help = in_one_line(run_espalier("lsystem --help").out);
  for (const lsystem::CommandInfo& info : lsystem::kCommands) {
    EXPECT_THAT(run.out, HasSubstr(std::string(info.help)));
    EXPECT_THAT(help, HasSubstr(in_one_line(std::string(info.help))));
  }
  EXPECT_THAT(read_text_file(ESPALIER_SOURCE_DIR "/docs/lsystem.md"), HasSubstr(run.out));
}

TEST(ReferenceCommand, HasALineForEachOptionOfAFit) {
  const ProgramRun run = run_espalier("reference fit");
  for (const FitOption& option : fit_options())
    EXPECT_THAT(run.out, HasSubstr(fmt::format("`{}` |", option.key)));
  EXPECT_THAT(read_text_file(ESPALIER_SOURCE_DIR "/docs/fit_options.md"), HasSubstr(run.out));
}

TEST(ReferenceCommand, RefusesAnUnknownTopic) {
  const ProgramRun run = run_espalier("reference trees");
  expect_one_clear_error(run);
  EXPECT_THAT(run.err, HasSubstr("measures"));
}

}  // namespace
}  // namespace espalier
