// Completion scripts name every command and option there is, and work in bash, zsh and fish; where one of the
// latter is not installed, its tests are skipped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include <espalier/app/completion.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

using testing::HasSubstr;

/// Words that bash offers for a command line ending in `words`, with the script of the program itself.
std::string bash_words(const std::string& words, int index) {
  return run_shell("bash -c \"source <('" ESPALIER_PROGRAM "' completion bash); COMP_WORDS=(" + words +
                   ") COMP_CWORD=" + std::to_string(index) + "; _espalier; echo \\\"\\${COMPREPLY[*]}\\\"\"")
      .out;
}

TEST(Completion, BashOffersTheCommandsThatFit) { EXPECT_EQ(bash_words("espalier spec", 1), "species\n"); }

TEST(Completion, BashOffersTheOptionsOfACommand) {
  EXPECT_EQ(bash_words("espalier params --fo", 2), "--format\n");
}

TEST(Completion, BashOffersPresets) { EXPECT_EQ(bash_words("espalier species quak", 2), "quaking_aspen\n"); }

TEST(Completion, BashOffersValuesOfOptions) {
  EXPECT_EQ(bash_words("espalier fit --optimizer cma", 3), "cma_es\n");
  EXPECT_EQ(bash_words("espalier render palm --season aut", 4), "autumn\n");
  EXPECT_EQ(bash_words("espalier fit --start rando", 3), "random:8\n");
  EXPECT_EQ(bash_words("espalier fit --seconds fi", 3), "\n") << "files are bash's own";
}

TEST(Completion, BashOffersLSystems) {
  EXPECT_EQ(bash_words("espalier lsystem fer", 2), "fern\n");
  EXPECT_EQ(bash_words("espalier render fer", 2), "fern.lsys\n");
}

TEST(Completion, BashOffersCommandsOfCommandsOnce) {
  EXPECT_EQ(bash_words("espalier experiment ru", 2), "run\n");
  EXPECT_EQ(bash_words("espalier experiment run ru", 3), "\n");
  EXPECT_EQ(bash_words("espalier experiment run --jo", 3), "--jobs\n");
}

bool has_shell(const std::string& shell) { return run_shell("command -v " + shell).exit_code == 0; }

/// What the script tells zsh's _arguments of a command line.
std::string zsh_arguments(const std::string& words, int current) {
  const ProgramRun run = run_shell(
      "zsh -f -c \"compdef() {}; _arguments() { print -rl -- \\\"\\$@\\\" }; source <('" ESPALIER_PROGRAM
      "' completion zsh); words=(" +
      words + ") CURRENT=" + std::to_string(current) + "; _espalier\"");
  EXPECT_EQ(run.err, "");
  return run.out;
}

TEST(Completion, ZshOffersValuesAndCommandsOfCommands) {
  if (!has_shell("zsh")) GTEST_SKIP() << "got no zsh";
  EXPECT_THAT(zsh_arguments("espalier fit ''", 3),
              testing::ContainsRegex("--optimizer.*:NAME:\\([^)]*cma_es"));
  EXPECT_THAT(zsh_arguments("espalier render ''", 3), testing::ContainsRegex("1:word:.*fern.lsys"));
  EXPECT_THAT(zsh_arguments("espalier experiment run ''", 4), HasSubstr("--jobs["));
  EXPECT_THAT(zsh_arguments("espalier experiment ''", 3), HasSubstr("1:word:{compadd -- run report check"));
}

/// What fish offers for a command line, without the descriptions.
std::string fish_words(const std::string& line) {
  return run_shell("fish -N -c \"source ('" ESPALIER_PROGRAM "' completion fish | psub); complete -C '" +
                   line + "'\" | cut -f 1 | tr '\\n' ' '")
      .out;
}

TEST(Completion, FishOffersValuesAndCommandsOfCommands) {
  if (!has_shell("fish")) GTEST_SKIP() << "got no fish";
  EXPECT_EQ(fish_words("espalier fit --optimizer cma"), "cma_es ");
  EXPECT_EQ(fish_words("espalier spec"), "species ");
  EXPECT_EQ(fish_words("espalier experiment ru"), "run ");
  EXPECT_EQ(fish_words("espalier experiment run --jo"), "--jobs ");
  EXPECT_EQ(fish_words("espalier lsystem fer"), "fern ");
}

TEST(Completion, EveryShellNamesEveryCommandAndOption) {
  CLI::App app{"A program", "espalier"};
  CLI::App* grow = app.add_subcommand("grow", "Grow it, don't [cut]: \\ it");
  int size = 0;
  grow->add_option("--size", size, "how large: metres");
  for (const std::string& script :
       {bash_completion(app, {}), zsh_completion(app, {}), fish_completion(app, {})}) {
    EXPECT_THAT(script, HasSubstr("grow"));
    EXPECT_THAT(script, HasSubstr("size"));
  }
}

TEST(Completion, RefusesAnUnknownShell) { expect_one_clear_error(run_espalier("completion powershell")); }

}  // namespace
}  // namespace espalier
