// Completion scripts name every command and option there is, and bash's works in bash.
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

TEST(Completion, EveryShellNamesEveryCommandAndOption) {
  CLI::App app{"A program", "espalier"};
  CLI::App* grow = app.add_subcommand("grow", "Grow it, don't [cut]: \\ it");
  int size = 0;
  grow->add_option("--size", size, "how large: metres");
  const std::vector<std::string> presets = {"oak"};
  for (const std::string& script :
       {bash_completion(app, presets), zsh_completion(app, presets), fish_completion(app, presets)}) {
    EXPECT_THAT(script, HasSubstr("grow"));
    EXPECT_THAT(script, HasSubstr("size"));
  }
}

TEST(Completion, RefusesAnUnknownShell) { expect_one_clear_error(run_espalier("completion powershell")); }

}  // namespace
}  // namespace espalier
