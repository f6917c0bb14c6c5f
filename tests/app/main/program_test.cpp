// The program as a function: every error is one line and an exit code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

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
           {}, {"prune"}, {"mask"}, {"mask", "oak\ntree", "-o", "a.png"}, {"mask", "palm", "--seeds", "1"}}) {
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.exit_code, 2) << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_THAT(ended.err, testing::MatchesRegex("espalier: [^\n]+\n"));
  }
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
