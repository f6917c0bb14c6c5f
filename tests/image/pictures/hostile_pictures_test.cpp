// Pictures from strangers: damaged ones are read or are one line, and what costs much to decode is not
// decoded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <filesystem>
#include <thread>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/image/pictures/decode.h>

#include "support/mutations.h"
#include "support/picture_files.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class HostilePictures : public testing::TestWithParam<const char*> {
 protected:
  ~HostilePictures() override { fs::remove_all(folder_); }

  /// The error of decoding these bytes; empty where they are decoded.
  std::string fault_of(const std::string& name, const std::string& bytes) const {
    test::write_bytes(folder_ / name, bytes);
    return fault_of(folder_ / name);
  }
  std::string fault_of(const fs::path& path) const {
    try {
      const DecodedPicture picture = decode_picture(path);
      EXPECT_EQ(picture.pixels.size(), static_cast<std::size_t>(picture.width_px) * picture.height_px);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path.string()));
      return error.what();
    }
    return "";
  }
  std::string bytes_of(const std::string& extension) const {
    const fs::path path = folder_ / ("sound." + extension);
    const bool has_floats = extension == "exr";
    test::write_samples(path, test::draw_tree(24, {.1f, .3f, .1f}, {1, 1, 1}),
                        has_floats ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8);
    return read_file(path);
  }

  fs::path folder_ = fresh_folder("hostile");
};

TEST_P(HostilePictures, DamagedTheyAreReadOrOneLine) {
  const std::string extension = GetParam(), sound = bytes_of(extension);
  ASSERT_EQ(fault_of("a." + extension, sound), "");
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < test::mutation_count(); ++i)
    refused += !fault_of("a." + extension, test::mutate(sound, random)).empty();
  EXPECT_GT(refused, 0);
}

INSTANTIATE_TEST_SUITE_P(Formats, HostilePictures,
                         testing::Values("png", "jpg", "gif", "tif", "webp", "bmp", "exr"));

TEST_F(HostilePictures, AnotherFormatBehindAKnownNameIsNotRead) {
  const std::string sgi = std::string("\x01\xda\x01\x01\0\x03\0\x40\0\x40\0\x03\0\0\0\0\0\0\0\xff", 20) +
                          std::string(492, '\0') + std::string(20'000, '\xff');
  for (const char* name : {"a.tif", "a.gif", "a.sgi"})
    EXPECT_THAT(fault_of(name, sgi),
                HasSubstr("expected PNG, JPEG, GIF, TIFF, WebP, BMP, EXR, HEIC, AVIF, PNM or TGA"));
}

TEST_F(HostilePictures, TheirNameMayBeThatOfAnotherFormat) {
  EXPECT_EQ(fault_of("a.tif", bytes_of("png")), "");
  EXPECT_EQ(fault_of("a", bytes_of("webp")), "");
}

TEST_F(HostilePictures, PipesAreNotOpened) {
  ASSERT_EQ(mkfifo((folder_ / "pipe.png").c_str(), 0600), 0);
  EXPECT_THAT(fault_of(folder_ / "pipe.png"), HasSubstr("is not a regular file"));
}

/// A progressive JPEG of one component, 10,000 pixels wide and high, whose scans are empty.
std::string jpeg_of_empty_scans(int scans) {
  std::string bytes("\xff\xd8\xff\xdb\0\x43\0", 7);
  bytes += std::string(64, '\x01') + std::string("\xff\xc2\0\x0b\x08\x27\x10\x27\x10\x01\x01\x11\0", 13);
  bytes += std::string("\xff\xc4\0\x14\0\x01", 6) + std::string(15, '\0') + std::string(1, '\0');
  for (int i = 0; i < scans; ++i) bytes += std::string("\xff\xda\0\x08\x01\x01\0\0\0\0", 10);
  return bytes + "\xff\xd9" + std::string(20'000, '\0');
}

TEST_F(HostilePictures, AJpegDoesNotGoOverItsPixelsWithoutEnd) {
  EXPECT_THAT(fault_of("a.jpg", jpeg_of_empty_scans(1000)),
              HasSubstr("claims 1000 scans of 100000000 pixels"));
  EXPECT_THAT(fault_of("a.jpg", jpeg_of_empty_scans(99)), HasSubstr("claims 99 scans"));
  std::string small = jpeg_of_empty_scans(101);
  small.replace(small.find("\x27\x10\x27\x10"), 4, std::string("\0\x40\0\x40", 4));
  EXPECT_THAT(fault_of("a.jpg", small), HasSubstr("claims 101 scans of 4096 pixels"));
}

TEST_F(HostilePictures, ClaimsOfTilesAreNotBelieved) {
  std::string tiff("II*\0\x08\0\0\0", 8);
  const auto number = [](std::uint32_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i);
    return text;
  };
  const std::pair<std::uint32_t, std::uint32_t> entries[] = {
      {256, 64}, {257, 64},     {258, 8},      {259, 1},   {262, 1},
      {277, 1},  {322, 160000}, {323, 160000}, {324, 200}, {325, 1000000}};
  tiff += number(std::size(entries), 2);
  for (const auto& [tag, value] : entries)
    tiff += number(tag, 2) + number(4, 2) + number(1, 4) + number(value, 4);
  EXPECT_THAT(fault_of("a.tif", tiff + std::string(100'000, '\0')), testing::Not(testing::IsEmpty()));
}

TEST_F(HostilePictures, ManyAtATimeAreRead) {
  const std::string sound = bytes_of("png");
  test::write_bytes(folder_ / "a.png", sound);
  std::vector<std::thread> threads;
  std::atomic<int> read = 0;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int j = 0; j < 10; ++j) read += decode_picture(folder_ / "a.png").width_px == 24;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(read, 40);
}

}  // namespace
}  // namespace espalier
