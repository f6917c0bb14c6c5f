#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include <espalier/core/error.h>
#include <espalier/image/measures/compare.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/image/reading/read_target.h>

#include "support/picture_files.h"
#include "support/random_masks.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using test::draw_tree;
using test::drawn_tree_mask;
using test::Samples;
using test::write_samples;
using testing::HasSubstr;

class ReadTarget : public testing::Test {
 protected:
  ~ReadTarget() override { fs::remove_all(folder_); }

  /// Writes the picture, reads it as a mask of its own size, and compares with the tree that was drawn.
  double iou_of_written(const std::string& file, const Samples& samples,
                        OIIO::TypeDesc type = OIIO::TypeDesc::UINT8, const TargetOptions& options = {}) {
    write_samples(folder_ / file, samples, type);
    const TargetPicture read = read_mask(folder_ / file, options);
    return iou(read.mask, drawn_tree_mask(samples.width_px));
  }

  fs::path folder_ = fresh_folder("read_target");
};

// --- formats and types

TEST_F(ReadTarget, LosslessFormatsGiveTheExactMask) {
  const Samples grey = draw_tree(100, {1}, {0}), colour = draw_tree(100, {.2f, .6f, .1f}, {.9f, .9f, 1});
  EXPECT_EQ(iou_of_written("a.png", grey), 1.0);
  EXPECT_EQ(iou_of_written("a16.png", grey, OIIO::TypeDesc::UINT16), 1.0);
  EXPECT_EQ(iou_of_written("a.tif", grey), 1.0);
  EXPECT_EQ(iou_of_written("a16.tif", colour, OIIO::TypeDesc::UINT16), 1.0);
  EXPECT_EQ(iou_of_written("a_float.tif", colour, OIIO::TypeDesc::FLOAT), 1.0);
  EXPECT_EQ(iou_of_written("a_half.exr", colour, OIIO::TypeDesc::HALF), 1.0);
  EXPECT_EQ(iou_of_written("a.exr", colour, OIIO::TypeDesc::FLOAT), 1.0);
  EXPECT_EQ(iou_of_written("a.bmp", colour), 1.0);
  EXPECT_EQ(iou_of_written("a.tga", colour), 1.0);
  EXPECT_EQ(iou_of_written("a.ppm", colour), 1.0);
  EXPECT_EQ(iou_of_written("a.gif", colour), 1.0);  // a palette
}

TEST_F(ReadTarget, LossyFormatsGiveNearlyTheMask) {
  const Samples colour = draw_tree(200, {.2f, .5f, .1f}, {.9f, .9f, 1});
  EXPECT_GT(iou_of_written("a.jpg", colour), 0.97);
  EXPECT_GT(iou_of_written("a.webp", colour), 0.97);
}

TEST_F(ReadTarget, TheExtensionNeedNotTellTheFormat) {
  write_samples(folder_ / "a.png", draw_tree(100, {1}, {0}));
  fs::rename(folder_ / "a.png", folder_ / "a.jpg");
  EXPECT_EQ(read_mask(folder_ / "a.jpg").mask, drawn_tree_mask(100));
}

TEST_F(ReadTarget, TilesAreReadLikeRows) {
  const Samples samples = draw_tree(150, {1, 1, 1}, {0, 0, 0});
  const auto output = OIIO::ImageOutput::create("tif");
  OIIO::ImageSpec spec(150, 150, 3, OIIO::TypeDesc::UINT8);
  spec.tile_width = spec.tile_height = 64;
  ASSERT_TRUE(output->open((folder_ / "tiles.tif").string(), spec));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, samples.values.data()));
  ASSERT_TRUE(output->close());
  EXPECT_EQ(read_mask(folder_ / "tiles.tif").mask, drawn_tree_mask(150));
}

TEST_F(ReadTarget, PhotographsAreTurnedUpright) {
  const int size = 90;
  // Where pixel (x, y) of the upright picture lies in the file, for each EXIF orientation.
  const std::function<std::pair<int, int>(int, int)> kPlaces[] = {
      [](int x, int y) {
        return std::pair{x, y};
      },
      [=](int x, int y) {
        return std::pair{size - 1 - x, y};
      },
      [=](int x, int y) {
        return std::pair{size - 1 - x, size - 1 - y};
      },
      [=](int x, int y) {
        return std::pair{x, size - 1 - y};
      },
      [](int x, int y) {
        return std::pair{y, x};
      },
      [=](int x, int y) {
        return std::pair{y, size - 1 - x};
      },
      [=](int x, int y) {
        return std::pair{size - 1 - y, size - 1 - x};
      },
      [=](int x, int y) {
        return std::pair{size - 1 - y, x};
      },
  };
  for (int orientation = 1; orientation <= 8; ++orientation) {
    Samples turned = test::blank(size, size, {0});
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const auto [u, v] = kPlaces[orientation - 1](x, y);
        turned.at(u, v) = test::drawn_tree(x, y, size) ? 1.0f : 0.0f;
      }
    write_samples(folder_ / "turned.tif", turned, OIIO::TypeDesc::UINT8, orientation);
    EXPECT_EQ(read_mask(folder_ / "turned.tif").mask, drawn_tree_mask(size)) << "orientation " << orientation;
  }
}

TEST_F(ReadTarget, LargePicturesAreAveragedWhileTheyAreRead) {
  write_samples(folder_ / "large.png", draw_tree(5000, {1}, {0}));
  const TargetPicture read = read_mask(folder_ / "large.png");
  EXPECT_EQ(read.mask.width_px(), 2500);
  EXPECT_EQ(read.source_width_px, 5000);
  EXPECT_GT(iou(read.mask, drawn_tree_mask(2500)), 0.995);
}

// --- telling the tree from the background

TEST_F(ReadTarget, AlphaIsUsedWhereItInforms) {
  // The colours alone would mislead: the hidden background is as green as the tree.
  const Samples cut_out = draw_tree(100, {.1f, .6f, .1f, 1}, {.1f, .6f, .1f, 0});
  EXPECT_EQ(iou_of_written("cut_out.png", cut_out), 1.0);
  EXPECT_THAT(read_mask(folder_ / "cut_out.png").how, HasSubstr("alpha"));
  EXPECT_EQ(iou_of_written("grey_alpha.png", draw_tree(100, {0, 1}, {1, 0})), 1.0);
}

TEST_F(ReadTarget, AlphaIsIgnoredWhereItIsOpaqueNearlyEverywhere) {
  Samples rounded = draw_tree(100, {.1f, .3f, .1f, 1}, {1, 1, 1, 1});
  rounded.at(0, 0, 3) = rounded.at(99, 0, 3) = 0;
  EXPECT_GT(iou_of_written("rounded.png", rounded), 0.99);
  EXPECT_THAT(read_mask(folder_ / "rounded.png").how, Not(HasSubstr("alpha")));
}

TEST_F(ReadTarget, TheBorderTellsWhichSideIsTheTree) {
  EXPECT_EQ(iou_of_written("white_on_black.png", draw_tree(100, {1}, {0})), 1.0);
  EXPECT_EQ(iou_of_written("black_on_white.png", draw_tree(100, {0}, {1})), 1.0);
  EXPECT_EQ(iou_of_written("green_on_white.png", draw_tree(100, {.5f, .9f, .5f}, {1, 1, 1})), 1.0);
  EXPECT_EQ(iou_of_written("red_on_green.png", draw_tree(100, {.8f, .1f, .1f}, {.1f, .4f, .1f})), 1.0);
}

TEST_F(ReadTarget, TheSideCanBeForced) {
  for (const float tree : {0.0f, 1.0f}) {
    write_samples(folder_ / "a.png", draw_tree(100, {tree}, {1 - tree}));
    TargetOptions light, dark;
    light.separation.side = TreeSide::light;
    dark.separation.side = TreeSide::dark;
    const Mask light_mask = read_mask(folder_ / "a.png", light).mask;
    EXPECT_EQ(light_mask == drawn_tree_mask(100), tree == 1.0f);
    EXPECT_EQ(area_px(light_mask) + area_px(read_mask(folder_ / "a.png", dark).mask), 100u * 100u);
  }
}

TEST_F(ReadTarget, TheMethodCanBeForced) {
  // Opaque everywhere near the tree, a light tree with a dark half: each method sees something else.
  Samples samples = draw_tree(100, {1, 1, 1, 1}, {.5f, .5f, .5f, 1});
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) {
      if (test::drawn_tree(x, y, 100) && x < 42)
        for (int c = 0; c < 3; ++c) samples.at(x, y, c) = 0;
      if (y < 5) samples.at(x, y, 3) = 0;
    }
  write_samples(folder_ / "a.png", samples);
  const auto area_by = [&](SeparationMethod method) {
    TargetOptions options;
    options.separation.method = method;
    return area_px(read_mask(folder_ / "a.png", options).mask);
  };
  EXPECT_EQ(area_by(SeparationMethod::alpha), 9500u);
  EXPECT_GE(area_by(SeparationMethod::background), area_px(drawn_tree_mask(100)));
  EXPECT_LT(area_by(SeparationMethod::luminance), area_px(drawn_tree_mask(100)));
}

TEST_F(ReadTarget, AlphaThatIsNotThereIsRefused) {
  write_samples(folder_ / "a.png", draw_tree(100, {1}, {0}));
  TargetOptions options;
  options.separation.method = SeparationMethod::alpha;
  EXPECT_THROW(read_mask(folder_ / "a.png", options), InputError);
}

TEST_F(ReadTarget, NoiseOfTheCameraIsNoTree) {
  Samples noisy = draw_tree(200, {.15f, .3f, .1f}, {.8f, .85f, .95f});
  const RandomKey key = root_key(1);
  for (std::size_t i = 0; i < noisy.values.size(); ++i)
    noisy.values[i] += 0.04f * uniform_signed(key, 0, static_cast<std::uint32_t>(i));
  EXPECT_GT(iou_of_written("noisy.jpg", noisy), 0.97);
}

TEST_F(ReadTarget, BrightSpotsOfAFloatPictureDoNotHideTheTree) {
  Samples sunny = draw_tree(100, {.02f, .02f, .02f}, {.5f, .6f, .9f});
  for (const float brightness : {50'000.0f, 3e38f, -3e38f}) {
    for (int c = 0; c < 3; ++c) sunny.at(90, 5, c) = brightness;
    EXPECT_GT(iou_of_written("sunny.exr", sunny, OIIO::TypeDesc::FLOAT), 0.99) << brightness;
  }
}

// --- cleaning, through the whole path

TEST_F(ReadTarget, SpecksAreRemovedAndPinholesKeptUnlessAsked) {
  Samples samples = draw_tree(256, {1}, {0});
  samples.at(250, 10) = 1;   // a speck far from the tree
  samples.at(108, 100) = 0;  // a pinhole in the crown
  write_samples(folder_ / "a.png", samples);
  write_samples(folder_ / "clean.png", draw_tree(256, {1}, {0}));
  TargetOptions fill;
  fill.size_px = 1024;
  TargetOptions plain = fill;
  fill.fill_pinholes = true;
  const Mask filled = read_target(folder_ / "a.png", fill).mask;
  EXPECT_EQ(filled, read_target(folder_ / "clean.png", plain).mask);
  EXPECT_LT(area_px(read_target(folder_ / "a.png", plain).mask), area_px(filled));
}

TEST_F(ReadTarget, AMaskOfOursKeepsItsShape) {
  write_mask_png(folder_ / "mask.png", drawn_tree_mask(512));
  const TargetPicture once = read_target(folder_ / "mask.png");
  write_mask_png(folder_ / "framed.png", once.mask);
  const TargetPicture twice = read_target(folder_ / "framed.png");
  EXPECT_GT(iou(once.mask, twice.mask), 0.98);
  EXPECT_NEAR(once.tree_height_px, twice.tree_height_px, 1.5f);
}

TEST_F(ReadTarget, HowIsOneLine) {
  write_samples(folder_ / "a.png", draw_tree(100, {1}, {0}));
  const std::string how = read_target(folder_ / "a.png").how;
  EXPECT_THAT(how, HasSubstr("luminance above"));
  EXPECT_THAT(how, HasSubstr("specks"));
  EXPECT_EQ(how.find('\n'), std::string::npos);
}

// --- bad input

class BadPictures : public testing::TestWithParam<test::BadPicture> {};

TEST_P(BadPictures, AreRefusedInOneLineThatNamesTheFile) {
  const fs::path folder = fresh_folder("bad_pictures");
  const fs::path path = folder / GetParam().file;
  GetParam().write(path);
  try {
    read_target(path);
    FAIL() << path << " was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(path.string()));
    EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
  }
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(ReadTarget, BadPictures, testing::ValuesIn(test::bad_pictures()),
                         [](const auto& info) {
                           std::string name = info.param.file;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

RC_GTEST_PROP(ReadTargetProperty, BytesAtRandomNeverCrash, ()) {
  const fs::path folder = fresh_folder("random_bytes");
  const auto bytes = *rc::gen::container<std::string>(rc::gen::arbitrary<char>());
  const std::string head = *rc::gen::element<std::string>("\x89PNG\r\n\x1a\n", "GIF89a", "\xff\xd8\xff\xe0",
                                                          "BM", "RIFF", "II*", "P5 ", "v/1\x01");
  test::write_bytes(folder / "random.png", head + bytes);
  RC_ASSERT_THROWS_AS(read_target(folder / "random.png"), InputError);
  fs::remove_all(folder);
}

class BadFrameSize : public testing::TestWithParam<int> {};
TEST_P(BadFrameSize, IsRefused) { EXPECT_THROW(check_frame_size(GetParam()), InputError); }
INSTANTIATE_TEST_SUITE_P(Sizes, BadFrameSize, testing::Values(-1, 0, 15, 4097, 2'000'000'000));

TEST(TargetOptions, UnknownNamesAreRefusedWithTheKnownOnes) {
  EXPECT_EQ(parse_name<SeparationMethod>("alpha"), SeparationMethod::alpha);
  EXPECT_EQ(parse_name<TreeSide>("dark"), TreeSide::dark);
  try {
    parse_name<SeparationMethod>("alhpa");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("auto, alpha, luminance, background"));
  }
  EXPECT_THROW(parse_name<TreeSide>("left"), InputError);
}

}  // namespace
}  // namespace espalier
