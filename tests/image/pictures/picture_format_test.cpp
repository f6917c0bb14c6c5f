// What the first bytes of a picture say: its format, its size, how often a JPEG goes over its pixels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include <espalier/core/files.h>
#include <espalier/image/pictures/claimed_size.h>
#include <espalier/image/pictures/jpeg_scans.h>
#include <espalier/image/pictures/picture_format.h>

#include "support/picture_files.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

TEST(PictureFormat, FilesThatAreWrittenTellFormatAndSize) {
  const std::pair<const char*, const char*> formats[] = {
      {"png", "png"}, {"jpg", "jpeg"}, {"gif", "gif"},   {"tif", "tiff"},   {"webp", "webp"},
      {"bmp", "bmp"}, {"ppm", "pnm"},  {"tga", "targa"}, {"exr", "openexr"}};
  const fs::path folder = fresh_folder("formats");
  for (const auto& [extension, reader] : formats) {
    const fs::path path = folder / (std::string("a.") + extension);
    test::Samples samples = test::draw_tree(64, {1, 1, 1}, {0, 0, 0});
    samples.height_px = 48;
    test::write_samples(path, samples,
                        path.extension() == ".exr" ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8);
    const std::string bytes = read_file(path);
    EXPECT_EQ(picture_format(bytes, path.extension()), reader);
    const auto size = claimed_size(bytes, reader);
    ASSERT_TRUE(size) << extension;
    EXPECT_EQ(size->width_px, 64) << extension;
    EXPECT_EQ(size->height_px, 48) << extension;
    for (std::size_t cut = 0; cut < std::min<std::size_t>(bytes.size(), 600); ++cut)
      claimed_size(bytes.substr(0, cut), reader);  // reads nothing behind the end: sanitizers watch
  }
}

TEST(PictureFormat, OthersAreNone) {
  const std::string sgi("\x01\xda\x01\x01\0\x03\0\x40\0\x40\0\x03", 12), dpx = "SDPX" + std::string(30, '\0');
  for (const std::string& bytes :
       {std::string(), sgi, dpx, std::string(5000, '\0'), std::string("8BPS\0\1", 6),
        std::string("SIMPLE  =   T"), std::string("RIFF1234AVI LIST"),
        std::string("\0\0\0\x18"
                    "ftypmp42",
                    12),
        std::string("P7\nWIDTH 8"), std::string("P5"), std::string("#EXTM3U\n")})
    for (const char* extension : {".png", ".tif", ".tga", ""})
      EXPECT_EQ(picture_format(bytes, extension), "");
}

TEST(PictureFormat, CamerasOfPhonesWriteHeif) {
  EXPECT_EQ(picture_format(std::string("\0\0\0\x18"
                                       "ftypheic",
                                       12),
                           ".HEIC"),
            "heif");
  EXPECT_EQ(picture_format(std::string("\0\0\0\x18"
                                       "ftypavif",
                                       12),
                           ""),
            "heif");
  const std::string sizes = std::string(
                                "\0\0\0\x14"
                                "ispe\0\0\0\0\0\0\x02\0\0\0\x02\0",
                                20) +
                            std::string(
                                "\0\0\0\x14"
                                "ispe\0\0\0\0\0\0\x0f\xc0\0\0\x0b\xd0",
                                20);
  const auto size = claimed_size(sizes, "heif");
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width_px, 4032);
  EXPECT_EQ(size->height_px, 3024);
}

TEST(ClaimedSize, OddClaimsAreNumbers) {
  EXPECT_EQ(claimed_size("P5 0 0 255\n", "pnm")->width_px, 0);
  EXPECT_EQ(claimed_size("P5 # wide\n 999999999 # high\n 7 255\n", "pnm")->width_px, 999999999);
  EXPECT_FALSE(claimed_size("P5 # without end", "pnm"));
  EXPECT_FALSE(claimed_size("anything", "unknown"));
  EXPECT_FALSE(claimed_size(std::string("II*\0\xff\xff\xff\xff", 8), "tiff"));
  EXPECT_EQ(claimed_size(
                "BM" + std::string(12, '\0') + std::string("\x28\0\0\0\x40\0\0\0\xc0\xff\xff\xff", 12), "bmp")
                ->height_px,
            64);  // from the top
}

/// A frame header and this many scans, each with some coded data.
std::string jpeg_of_scans(int scans) {
  std::string bytes("\xff\xd8\xff\xe1\0\x06\xff\xda\xff\xd9", 10);  // a segment that holds markers
  bytes += std::string("\xff\xc2\0\x0b\x08\0\x40\0\x30\x01\x01\x11\0", 13);
  for (int i = 0; i < scans; ++i)
    bytes += std::string("\xff\xda\0\x08\x01\x01\0\0\x3f\0", 10) +
             std::string("\x12\xff\0\x34\xff\xd0\xff\xff\x01", 9);
  return bytes + "\xff\xd9";
}

TEST(JpegScans, AreCountedUpToTheEnd) {
  for (const int scans : {0, 1, 3, 1000}) EXPECT_EQ(count_jpeg_scans(jpeg_of_scans(scans)), scans);
  EXPECT_EQ(count_jpeg_scans(jpeg_of_scans(2) + std::string("\0\0\xff\xda\0\x08", 6)),
            2);  // what phones append
  const auto size = claimed_size(jpeg_of_scans(1), "jpeg");
  EXPECT_EQ(size->width_px, 48);
  EXPECT_EQ(size->height_px, 64);
}

TEST(JpegScans, CutOffAnywhereTheirEndIsMissing) {
  const std::string bytes = jpeg_of_scans(3);
  EXPECT_FALSE(is_jpeg_without_end(bytes));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_TRUE(is_jpeg_without_end(bytes.substr(0, size))) << size;
}

}  // namespace
}  // namespace espalier
