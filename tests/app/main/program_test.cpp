// The program as a function: every error is one line and an exit code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include <espalier/app/main/old_names.h>
#include <espalier/app/main/program.h>

namespace espalier {
namespace {

struct Ended {
  int exit_code;
  std::string out, err;
};

Ended run(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "espalier");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int code = run_program(static_cast<int>(arguments.size()), arguments.data());
  return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

TEST(Program, BadInputIsOneLineAndExitCode2) {
  for (const std::vector<const char*>& arguments : std::vector<std::vector<const char*>>{
           {"prune"}, {"mask"}, {"mask", "oak\ntree", "-o", "a.png"}, {"mask", "palm", "--seeds", "1"}}) {
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.exit_code, 2) << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_THAT(ended.err, testing::MatchesRegex("espalier: [^\n]+\n"));
  }
}

TEST(Program, AloneListsTheCommands) {
  const Ended alone = run({}), help = run({"--help"}), experiment = run({"experiment"});
  EXPECT_EQ(alone.exit_code, 0);
  EXPECT_EQ(alone.out, help.out);
  EXPECT_EQ(experiment.exit_code, 0);
  EXPECT_THAT(experiment.out, testing::HasSubstr("\n  report "));
}

/// Names of the commands in a help text, by their indentation.
std::vector<std::string> commands_in_help(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream lines(help.substr(0, help.find("\nExamples:")));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  ") && line.size() > 2 && line[2] >= 'a' && line[2] <= 'z')
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

/// In characters: bytes that continue one do not count.
std::size_t longest_line(const std::string& text) {
  std::size_t longest = 0, length = 0;
  for (const char byte : text) {
    if ((static_cast<unsigned char>(byte) & 0xC0) != 0x80) ++length;
    if (byte == '\n') longest = std::max(longest, length - 1), length = 0;
  }
  return longest;
}

/// The lines of the first paragraph behind "Examples:".
std::size_t count_examples(const std::string& help) {
  const auto begin = help.find("\nExamples:\n");
  if (begin == std::string::npos) return 0;
  const std::string paragraph = help.substr(begin + 10, help.find("\n\n", begin + 10) - begin - 10);
  std::size_t count = 0;
  for (auto at = paragraph.find("\n  "); at != std::string::npos; at = paragraph.find("\n  ", at + 1))
    ++count;
  return count;
}

TEST(Program, HelpOfEveryCommandHasExamplesIn100Columns) {
  std::vector<std::vector<const char*>> commands = {{"--help"}};
  const std::vector<std::string> names = commands_in_help(run({"--help"}).out),
                                 studies = commands_in_help(run({"experiment"}).out);
  ASSERT_GT(names.size(), 15u);
  ASSERT_GT(studies.size(), 3u);
  for (const std::string& name : names) commands.push_back({name.c_str(), "--help"});
  for (const std::string& name : studies) commands.push_back({"experiment", name.c_str(), "--help"});
  for (const std::vector<const char*>& command : commands) {
    const Ended ended = run(command);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_LE(longest_line(ended.out), 100u) << ended.out;
    EXPECT_EQ(count_examples(ended.out), 3u) << ended.out;
  }
}

TEST(Program, OptionsStandInGroups) {
  const std::string help = run({"fit", "--help"}).out;
  for (const char* group : {"\nHow the picture is read:\n", "\nHow long, and how large:\n", "\nThe run:\n"})
    EXPECT_THAT(help, testing::HasSubstr(group));
}

TEST(Program, NamesOfOtherVersionsAndCommandsAreTaken) {
  for (const std::vector<const char*>& words : std::vector<std::vector<const char*>>{
           {"compare", "a.png", "b.png", "--method", "alpha"},
           {"compare", "a.png", "b.png", "--method=alpha", "--side", "dark"},
           {"fit", "a.png", "--method", "alpha", "--side", "dark", "--set", "levels=2", "--out", "b"},
           {"render", "nothing.toml", "--out", "a.png"}})
    EXPECT_THAT(run(words).err, testing::ContainsRegex("(a.png|nothing.toml): (there is )?no such file"))
        << words[0];
}

TEST(Program, WordsBehindTwoDashesAreNoNames) {
  const std::vector<std::string> words = with_names_of_today({"fit", "--side", "dark", "--", "--side"});
  EXPECT_EQ(words, (std::vector<std::string>{"fit", "--tree-side", "dark", "--", "--side"}));
  EXPECT_EQ(with_names_of_today({"target", "--side=dark"}).back(), "--tree-side=dark");
  EXPECT_EQ(with_names_of_today({"render", "--side"}).back(), "--side");
}

TEST(Program, HelpNamesEveryCommandAndExitsWith0) {
  const Ended ended = run({"--help"});
  EXPECT_EQ(ended.exit_code, 0);
  for (const char* command : {"fit", "target", "compare", "mask", "render", "mesh", "bench", "experiment",
                              "species", "lsystem", "space", "blend", "posterior", "params", "completion"})
    EXPECT_THAT(ended.out, testing::HasSubstr(std::string("\n  ") + command));
}

}  // namespace
}  // namespace espalier
