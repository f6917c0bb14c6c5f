// What the room gives to who links it, and that samples come back as they were written.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <vector>

#include <espalier/image/openimageio/openimageio_codecs.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

TEST(OpenImageIoCodecs, ServeWhoeverLinksTheirRoom) {
  EXPECT_EQ(&picture_codecs(), espalier_openimageio_codecs());
}

TEST(OpenImageIoCodecs, APngHasTheSamplesThatWereEncoded) {
  const std::vector<std::uint8_t> samples = {255, 0, 0, 255, 0, 255, 0, 51, 0, 0, 255, 102, 0, 0, 0, 0};
  const EncodedPicture encoded = espalier_openimageio_codecs()->encode_png("a.png", 2, 2, 4, samples.data());
  ASSERT_EQ(encoded.error, "");
  const auto path = fresh_folder("codecs") / "a.png";
  std::ofstream(path, std::ios::binary) << encoded.bytes;
  std::string error;
  const auto input = espalier_openimageio_codecs()->open(path.string(), "png", 0, error);
  ASSERT_TRUE(input) << error;
  EXPECT_EQ(input->layout().width_px, 2);
  EXPECT_EQ(input->layout().height_px, 2);
  EXPECT_EQ(input->layout().alpha, 3);
  std::array<float, 16> read{};
  ASSERT_TRUE(input->read_rows(0, 2, read.data())) << input->error();
  EXPECT_EQ(read[0], 1);
  EXPECT_FLOAT_EQ(read[7], 0.2f);
  EXPECT_FLOAT_EQ(read[11], 0.4f);
}

TEST(OpenImageIoCodecs, SizesThatAreNoneAreErrorsInWords) {
  const std::uint8_t sample = 0;
  EXPECT_NE(espalier_openimageio_codecs()->encode_png("a.png", 0, 5, 1, &sample).error, "");
}

}  // namespace
}  // namespace espalier
