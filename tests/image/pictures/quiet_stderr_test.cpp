#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <memory>

#include <espalier/image/pictures/quiet_stderr.h>

namespace espalier {
namespace {

/// Which file stderr is.
std::pair<dev_t, ino_t> stderr_file() {
  struct stat status {};
  fstat(STDERR_FILENO, &status);
  return {status.st_dev, status.st_ino};
}

TEST(QuietStderr, StderrComesBackWhenOverlappingLivesEndInAnyOrder) {
  const auto before = stderr_file();
  auto first = std::make_unique<QuietStderr>(), second = std::make_unique<QuietStderr>();
  const auto off = stderr_file();
  first.reset();
  EXPECT_EQ(stderr_file(), off) << "still off for the second";
  second.reset();
  EXPECT_EQ(stderr_file(), before);
}

}  // namespace
}  // namespace espalier
