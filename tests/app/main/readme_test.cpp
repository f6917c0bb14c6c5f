// Every command of the README runs, in its order, in an empty directory that holds the bundled targets and
// experiments. Searches and sheets are cut short; ./espalier test is left out, since this is it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace espalier {
namespace {

namespace fs = std::filesystem;

/// The lines of all ```sh blocks.
std::vector<std::string> readme_commands() {
  std::ifstream readme(fs::path(ESPALIER_SOURCE_DIR) / "README.md");
  std::vector<std::string> commands;
  bool inside = false;
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with("```"))
      inside = line == "```sh";
    else if (inside && !line.empty())
      commands.push_back(line);
  }
  return commands;
}

std::string shortened(std::string command) {
  command = std::regex_replace(command, std::regex("^\\./espalier"), ESPALIER_PROGRAM);
  command = std::regex_replace(command, std::regex("--seconds [0-9]+"), "--evaluations 45 --branch-rounds 1");
  command =
      std::regex_replace(command, std::regex("espalier posterior"), "espalier posterior --simulations 2000");
  command = std::regex_replace(command, std::regex("--evaluations 300"), "--evaluations 45");
  command = std::regex_replace(command, std::regex("--grid 7x7"), "--grid 2x2");
  return std::regex_replace(command, std::regex("--evaluations 600"), "--evaluations 60");
}

TEST(Readme, EveryCommandRuns) {
  const fs::path directory = fs::temp_directory_path() / ("espalier_readme_" + std::to_string(getpid()));
  fs::create_directories(directory);
  for (const char* folder : {"targets", "experiments"})
    fs::create_directory_symlink(fs::path(ESPALIER_SOURCE_DIR) / folder, directory / folder);
  const std::vector<std::string> commands = readme_commands();
  ASSERT_GE(commands.size(), 10u);
  for (const std::string& command : commands) {
    ASSERT_TRUE(command.starts_with("./espalier ")) << command;
    if (command == "./espalier test") continue;
    const std::string line = "cd '" + directory.string() + "' && " + shortened(command) + " >out.txt 2>&1";
    EXPECT_EQ(std::system(line.c_str()), 0) << command;
  }
  fs::remove_all(directory);
}

}  // namespace
}  // namespace espalier
