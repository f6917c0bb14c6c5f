// Laws of animated GIFs: what is read back is the frames that were added.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include <espalier/core/error.h>
#include <espalier/image/pictures/animation.h>

namespace espalier {
namespace {

TEST(Animation, HoldsItsFramesInOrder) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("espalier_" + std::to_string(getpid()) + ".gif");
  const std::vector<Rgb> colors{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}};
  Animation animation(17, 9, 3, 0.25);
  for (const Rgb color : colors) animation.add(Picture(17, 9, color));
  EXPECT_FALSE(std::filesystem::exists(path));
  animation.write(path);
  const auto input = OIIO::ImageInput::open(path.string());
  ASSERT_TRUE(input) << OIIO::geterror();
  int frames = 0;
  for (; input->seek_subimage(frames, 0); ++frames) {
    const OIIO::ImageSpec& spec = input->spec();
    EXPECT_EQ(spec.width, 17);
    EXPECT_EQ(spec.height, 9);
    EXPECT_NEAR(spec.get_float_attribute("FramesPerSecond"), 4, 0.1);
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(17 * 9 * spec.nchannels));
    ASSERT_TRUE(input->read_image(frames, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, pixels.data()));
    const Rgb expected = colors[static_cast<std::size_t>(frames)];
    const std::size_t middle = static_cast<std::size_t>((4 * 17 + 8) * spec.nchannels);
    EXPECT_NEAR(pixels[middle], expected.r, 8);
    EXPECT_NEAR(pixels[middle + 1], expected.g, 8);
    EXPECT_NEAR(pixels[middle + 2], expected.b, 8);
  }
  EXPECT_EQ(frames, 3);
  std::filesystem::remove(path);
}

TEST(Animation, PathsThatCannotBeWrittenAreOneLine) {
  Animation animation(4, 4, 1, 0.1);
  animation.add(Picture(4, 4));
  EXPECT_THROW(animation.write("/nowhere/at/all.gif"), InputError);
}

}  // namespace
}  // namespace espalier
