// Programs that touch no picture file do without OpenImageIO's libraries.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <espalier/core/files.h>
#include <espalier/image/codecs/codecs.h>

namespace espalier {
namespace {

bool is_loaded(const std::string& library) {
  return read_file("/proc/self/maps").find(library) != std::string::npos;
}

TEST(Codecs, AreLoadedWithTheFirstFile) {
  EXPECT_FALSE(is_loaded("libOpenImageIO"));
  std::string error;
  EXPECT_EQ(picture_codecs().open("/nowhere/picture.png", "png", 0, error), nullptr);
  EXPECT_THAT(error, testing::HasSubstr("/nowhere/picture.png"));
  EXPECT_TRUE(is_loaded("libOpenImageIO"));
}

}  // namespace
}  // namespace espalier
