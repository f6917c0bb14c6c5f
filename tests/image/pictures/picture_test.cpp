#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>

#include <espalier/core/error.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/image/reading/read_target.h>

#include "support/picture_files.h"
#include "support/random_masks.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

class WritePicture : public testing::Test {
 protected:
  ~WritePicture() override { fs::remove_all(folder_); }
  fs::path folder_ = fresh_folder("write_picture");
};

TEST_F(WritePicture, PixelsReadBackAsTheyWere) {
  Picture picture(5, 3, {1, 2, 3});
  picture.at(4, 2) = {200, 100, 50};
  write_png(folder_ / "a.png", picture);
  const auto input = OIIO::ImageInput::open((folder_ / "a.png").string());
  ASSERT_TRUE(input);
  EXPECT_EQ(input->spec().width, 5);
  EXPECT_EQ(input->spec().height, 3);
  EXPECT_EQ(input->spec().nchannels, 3);
  std::vector<Rgb> pixels(15);
  ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()));
  EXPECT_EQ(pixels, picture.pixels);
}

TEST_F(WritePicture, MasksReadBackAsTheyWere) {
  const Mask mask = test::drawn_tree_mask(130);
  write_mask_png(folder_ / "mask.png", mask);
  EXPECT_EQ(read_mask(folder_ / "mask.png").mask, mask);
}

TEST_F(WritePicture, TheSamePictureGivesTheSameBytes) {
  write_mask_png(folder_ / "a.png", test::drawn_tree_mask(130));
  write_mask_png(folder_ / "b.png", test::drawn_tree_mask(130));
  EXPECT_EQ(read_text_file(folder_ / "a.png"), read_text_file(folder_ / "b.png"));
}

TEST_F(WritePicture, AnExistingFileIsReplacedAndNothingElseIsLeft) {
  test::write_bytes(folder_ / "a.png", "old");
  write_mask_png(folder_ / "a.png", test::drawn_tree_mask(64));
  EXPECT_EQ(read_mask(folder_ / "a.png").mask, test::drawn_tree_mask(64));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(WritePicture, APictureWithoutPixelsIsRefused) {
  EXPECT_THROW(write_png(folder_ / "a.png", Picture{}), InputError);
  EXPECT_TRUE(fs::is_empty(folder_));
}

RC_GTEST_PROP(Overlay, ColoursTellTheFourCasesApart, ()) {
  const auto [candidate, target] = test::draw_pair(80);
  const Picture picture = overlay(candidate, target);
  for (int y = 0; y < target.height_px(); ++y)
    for (int x = 0; x < target.width_px(); ++x) {
      const bool ours = candidate.get(x, y), theirs = target.get(x, y);
      const Rgb expected = ours && theirs ? Rgb{255, 255, 255}
                           : ours         ? kSurplusColor
                           : theirs       ? kMissedColor
                                          : Rgb{};
      RC_ASSERT(picture.at(x, y) == expected);
    }
}

TEST(Overlay, MasksOfDifferentSizesAreRefused) {
  EXPECT_THROW(overlay(Mask(8, 8), Mask(8, 9)), InternalError);
}

}  // namespace
}  // namespace espalier
