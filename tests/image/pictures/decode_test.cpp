// Picture files that say more, or less, than their pixels: turned, named oddly, of several frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/image/pictures/animation.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/image/pictures/file_chunks.h>

#include "support/picture_files.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

class Decode : public testing::Test {
 protected:
  ~Decode() override { fs::remove_all(folder_); }

  fs::path folder_ = fresh_folder("decode");
};

/// A chunk of EXIF that says how a WebP is turned, behind its pixels.
void append_orientation(const fs::path& path, char orientation) {
  std::string bytes = read_file(path);
  const std::string exif = std::string("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0", 18) + orientation +
                           std::string("\0\0\0\0\0\0\0", 7);
  bytes += "EXIF" + std::string{static_cast<char>(exif.size()), 0, 0, 0} + exif;
  const auto size = static_cast<std::uint32_t>(bytes.size() - 8);
  for (int i = 0; i < 4; ++i) bytes[4 + i] = static_cast<char>(size >> 8 * i);
  test::write_bytes(path, bytes);
}

TEST_F(Decode, AWebpIsTurnedAsItsExifSays) {
  test::write_samples(folder_ / "a.webp", test::draw_tree(64, {.1f, .3f, .1f}, {1, 1, 1}));
  EXPECT_EQ(webp_orientation(read_file(folder_ / "a.webp")), 1);
  const DecodedPicture upright = decode_picture(folder_ / "a.webp");
  append_orientation(folder_ / "a.webp", 3);
  EXPECT_EQ(webp_orientation(read_file(folder_ / "a.webp")), 3);
  const DecodedPicture turned = decode_picture(folder_ / "a.webp");
  for (const auto& [x, y] : {std::pair{3, 60}, {27, 25}, {27, 50}})
    EXPECT_EQ(turned.at(63 - x, 63 - y), upright.at(x, y)) << x << ", " << y;
}

TEST_F(Decode, NamesMayHoldWhatLibrariesReadOtherwise) {
  for (const char* name : {"what tree?.png", "100%25.png", "tree #2.png", "a?b=c.tga"}) {
    test::write_samples(folder_ / "plain.tga", test::draw_tree(64, {1, 1, 1}, {0, 0, 0}));
    test::write_samples(folder_ / "plain.png", test::draw_tree(64, {1, 1, 1}, {0, 0, 0}));
    fs::rename(folder_ / (std::string("plain") + fs::path(name).extension().string()), folder_ / name);
    EXPECT_EQ(decode_picture(folder_ / name).width_px, 64) << name;
  }
}

TEST_F(Decode, BlankFramesAreSkippedUnlessOneIsAskedFor) {
  const Picture blank(32, 32, {255, 255, 255});
  Picture tree = blank;
  for (int y = 8; y < 24; ++y) tree.at(16, y) = {0, 0, 0};
  Animation animation(32, 32, 3, 0.1);
  for (const Picture& frame : {blank, blank, tree}) animation.add(frame);
  animation.write(folder_ / "a.gif");
  const DecodedPicture first = decode_picture(folder_ / "a.gif");
  EXPECT_EQ(first.frame, 3);
  EXPECT_EQ(first.blank_frames, 2);
  EXPECT_LT(first.at(16, 12)[0], 0.1f);
  EXPECT_GT(decode_picture(folder_ / "a.gif", 1).at(16, 12)[0], 0.9f);
  try {
    decode_picture(folder_ / "a.gif", 4);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("got frame 4, expected 1 to 3"));
  }
}

TEST_F(Decode, FilesWithoutAPaletteHaveNone) {
  test::write_samples(folder_ / "a.png", test::draw_tree(64, {1}, {0}));
  EXPECT_TRUE(png_palette(read_file(folder_ / "a.png")).empty());
  EXPECT_TRUE(decode_picture(folder_ / "a.png").is_grey);
  EXPECT_EQ(decode_picture(folder_ / "a.png").bits, 8);
}

}  // namespace
}  // namespace espalier
