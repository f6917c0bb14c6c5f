// Kinds of pictures that a tree comes in, each made small here, and read as a person would. The same kinds as
// files lie in ../shared/defects/pictures for whoever has them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include <espalier/core/error.h>
#include <espalier/core/random.h>
#include <espalier/image/measures/compare.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/image/reading/read_target.h>

#include "support/picture_files.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using test::Samples;
using testing::HasSubstr;

constexpr int kSidePx = 200;

struct Leaf {
  double x, y, radius;
};

/// Small leaves in a round crown, with gaps between them, on a trunk.
std::vector<Leaf> drawn_leaves() {
  std::vector<Leaf> leaves;
  const RandomKey key = root_key(7);
  for (std::uint32_t i = 0; leaves.size() < 260; ++i) {
    const double x = uniform_signed(key, 0, 3 * i), y = uniform_signed(key, 0, 3 * i + 1);
    if (x * x + y * y > 1) continue;
    leaves.push_back({100 + 62 * x, 80 + 62 * y, 3 + 1.2 * uniform_signed(key, 0, 3 * i + 2)});
  }
  return leaves;
}

/// How much of each pixel the tree covers, of 16 samples.
const std::vector<float>& cover_of_tree() {
  static const std::vector<float> cover = [] {
    const std::vector<Leaf> all = drawn_leaves();
    std::vector<float> values(kSidePx * kSidePx);
    for (int y = 0; y < kSidePx; ++y)
      for (int x = 0; x < kSidePx; ++x) {
        int inside = 0;
        for (int sample = 0; sample < 16; ++sample) {
          const double u = x + (sample % 4 + 0.5) / 4, v = y + (sample / 4 + 0.5) / 4;
          const bool is_trunk = std::fabs(u - 100) < 5 && v > 80 && v < 188;
          inside +=
              is_trunk || std::any_of(all.begin(), all.end(), [&](const Leaf& leaf) {
                return (u - leaf.x) * (u - leaf.x) + (v - leaf.y) * (v - leaf.y) < leaf.radius * leaf.radius;
              });
        }
        values[y * kSidePx + x] = static_cast<float>(inside) / 16;
      }
    return values;
  }();
  return cover;
}

Mask true_mask() {
  Mask mask(kSidePx, kSidePx);
  for (int y = 0; y < kSidePx; ++y)
    for (int x = 0; x < kSidePx; ++x) mask.set(x, y, cover_of_tree()[y * kSidePx + x] >= 0.5f);
  return mask;
}

using Paint = std::vector<float>;

/// The tree over a ground.
Samples paint(const std::function<Paint(int, int)>& ground, const Paint& tree, float noise = 0) {
  Samples samples = test::blank(kSidePx, kSidePx, tree);
  const RandomKey key = root_key(3);
  for (int y = 0; y < kSidePx; ++y)
    for (int x = 0; x < kSidePx; ++x) {
      const Paint behind = ground(x, y);
      const float share = cover_of_tree()[y * kSidePx + x];
      for (int c = 0; c < samples.channels; ++c)
        samples.at(x, y, c) = share * tree[c] + (1 - share) * behind[c] +
                              noise * uniform_signed(key, c, static_cast<std::uint32_t>(y * kSidePx + x));
    }
  return samples;
}

std::function<Paint(int, int)> plain_ground(const Paint& color) {
  return [color](int, int) { return color; };
}

void paint_box(Samples& samples, int left, int top, int right, int bottom, float value) {
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x)
      for (int c = 0; c < samples.channels; ++c) samples.at(x, y, c) = value;
}

const Paint kLeafPaint = {.2f, .4f, .15f}, kBlackPaint = {.05f, .05f, .05f}, kWhitePaint = {1, 1, 1};

Paint sky_over_lawn(int, int y) {
  const float down = static_cast<float>(y) / kSidePx;
  if (y >= 176) return {.38f, .55f, .22f};
  return {.25f + .5f * down, .5f + .4f * down, .85f + .1f * down};
}

Paint dusk(int, int y) {
  const float down = static_cast<float>(y) / kSidePx;
  return {.25f + .7f * down, .2f + .5f * down, .4f - .1f * down};
}

Paint vignette(int x, int y) {
  const float u = static_cast<float>(x) / kSidePx - .5f, v = static_cast<float>(y) / kSidePx - .5f;
  const float value = .95f - .7f * (u * u + v * v);
  return {value, value, value};
}

class PictureKinds : public testing::Test {
 protected:
  ~PictureKinds() override { fs::remove_all(folder_); }

  /// The tree that is read, beside the one that was drawn, in the frame.
  TargetPicture read(const std::string& file, const TargetOptions& options = {.size_px = kSidePx}) {
    return read_target(folder_ / file, options);
  }

  void expect_tree(const TargetPicture& target, double least_iou, double least_gap_iou) {
    const Mask truth = frame_mask(true_mask(), kSidePx).mask;
    EXPECT_GT(iou(target.mask, truth), least_iou) << target.how;
    EXPECT_GT(gap_iou(target.mask, truth), least_gap_iou) << target.how;
  }

  void expect_tree_of(const Samples& samples, double least_iou, double least_gap_iou,
                      const std::string& file = "a.png") {
    test::write_samples(folder_ / file, samples);
    expect_tree(read(file), least_iou, least_gap_iou);
  }

  std::string error_of(const std::string& file, const TargetOptions& options) {
    try {
      read(file, options);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  fs::path folder_ = fresh_folder("picture_kinds");
};

// --- grounds

TEST_F(PictureKinds, FineFoliageKeepsItsGapsOnPlainGrounds) {
  for (const float ground : {1.0f, 0.0f, 0.6f})
    expect_tree_of(paint(plain_ground({ground, ground, ground}), kLeafPaint), .97, .9);
}

TEST_F(PictureKinds, ASoftMaskIsCutAtOneHalf) { expect_tree_of(paint(plain_ground({0}), {1}), .99, .97); }

TEST_F(PictureKinds, GroundsThatVaryAreNoTree) {
  expect_tree_of(paint(sky_over_lawn, kLeafPaint), .96, .88);
  expect_tree_of(paint(dusk, kBlackPaint), .96, .88);
  expect_tree_of(paint(vignette, kBlackPaint), .96, .88);
  expect_tree_of(paint(vignette, kBlackPaint, .01f), .95, .85);
}

// --- marks

TEST_F(PictureKinds, FramesLinesCaptionsAndPersonsSetNeitherFootNorScale) {
  const Samples figure = paint(plain_ground(kWhitePaint), kLeafPaint);
  Samples framed = figure, lined = figure, captioned = figure, peopled = figure;
  paint_box(framed, 0, 0, kSidePx, 6, 0), paint_box(framed, 0, 194, kSidePx, kSidePx, 0);
  paint_box(framed, 0, 0, 6, kSidePx, 0), paint_box(framed, 194, 0, kSidePx, kSidePx, 0);
  paint_box(lined, 0, 188, kSidePx, 190, 0);
  for (int letter = 0; letter < 8; ++letter) paint_box(captioned, 10 + 6 * letter, 4, 14 + 6 * letter, 10, 0);
  paint_box(captioned, 8, 193, 48, 195, 0);
  paint_box(peopled, 175, 150, 185, 187, .1f);
  expect_tree_of(framed, .96, .88);
  EXPECT_THAT(read("a.png").left_out.front(), HasSubstr("6 px left"));
  expect_tree_of(lined, .96, .88);
  expect_tree_of(captioned, .96, .88);
  EXPECT_EQ(read("a.png").left_out.size(), 2u);
  expect_tree_of(peopled, .96, .88);
  EXPECT_THAT(read("a.png").left_out.front(), HasSubstr("figure"));
  TargetOptions keep{.size_px = kSidePx};
  keep.hints.keep_marks = "figures";
  EXPECT_TRUE(read("a.png", keep).left_out.empty());
}

TEST_F(PictureKinds, AScaleBarTellsTheTreesHeight) {
  test::write_samples(folder_ / "a.png", paint(plain_ground(kWhitePaint), kLeafPaint));
  TargetOptions options{.size_px = kSidePx};
  options.hints.scale_bar = "40=2.5";
  const Mask truth = true_mask();
  int top = 0;
  while (std::none_of(truth.row(top).begin(), truth.row(top).end(),
                      [](std::uint64_t word) { return word != 0; }))
    ++top;
  EXPECT_NEAR(read("a.png", options).height_m.value_or(0), (188 - top) * 2.5 / 40, .1);
  EXPECT_FALSE(read("a.png").height_m);
}

// --- labels

Samples label_picture_of(const std::vector<float>& tree, const std::vector<float>& other) {
  Samples labels = test::blank(kSidePx, kSidePx, std::vector<float>(tree.size(), 0.0f));
  for (int y = 0; y < kSidePx; ++y)
    for (int x = 0; x < kSidePx; ++x)
      for (int c = 0; c < labels.channels; ++c)
        labels.at(x, y, c) = cover_of_tree()[y * kSidePx + x] >= .5f ? tree[c] : y > 180 ? other[c] : 0;
  return labels;
}

TEST_F(PictureKinds, LabelsOfSmallNumbersAreExact) {
  for (const auto& [file, type, most] :
       {std::tuple{"a.png", OIIO::TypeDesc::UINT8, 255.0f}, {"b.png", OIIO::TypeDesc::UINT16, 65535.0f}}) {
    test::write_samples(folder_ / file, label_picture_of({1 / most}, {0}), type);
    expect_tree(read(file), .999, .999);
  }
}

TEST_F(PictureKinds, OfSeveralLabelsTheChoicesAreListed) {
  test::write_samples(folder_ / "a.png", label_picture_of({3 / 255.0f}, {2 / 255.0f}));
  EXPECT_THAT(error_of("a.png", {}),
              testing::AllOf(HasSubstr("3 ("), HasSubstr("2 ("), HasSubstr("--label")));
  TargetOptions options{.size_px = kSidePx};
  options.hints.label = "3";
  expect_tree(read("a.png", options), .999, .999);
  options.hints.label = "9";
  EXPECT_THAT(error_of("a.png", options),
              testing::AllOf(HasSubstr("'9'"), HasSubstr("3 ("), HasSubstr("0 (")));
}

TEST_F(PictureKinds, ColoursOfAColorMapAreLabels) {
  const float half = 128 / 255.0f;
  test::write_samples(folder_ / "a.png", label_picture_of({half, 0, 0}, {0, half, 0}));
  EXPECT_THAT(error_of("a.png", {}), HasSubstr(": 800000 ("));
  TargetOptions options{.size_px = kSidePx};
  options.hints.label = "800000";  // a "#" would begin a comment of the shell
  expect_tree(read("a.png", options), .999, .999);
}

TEST_F(PictureKinds, WhatNobodyLookedAtBelongsToWhatIsNearest) {
  Samples labels = test::blank(kSidePx, kSidePx, {0});
  paint_box(labels, 60, 40, 140, 180, 1);  // void: a ring three pixels to both sides of a box
  paint_box(labels, 66, 46, 134, 174, 1 / 255.0f);
  test::write_samples(folder_ / "a.png", labels);
  EXPECT_NEAR(static_cast<double>(area_px(read("a.png").source_tree)), 74 * 134, 8)
      << "its corners are round";
}

// --- alpha

Samples with_alpha(const Samples& picture, const std::function<float(int, int)>& alpha) {
  Samples samples = test::blank(kSidePx, kSidePx, {0, 0, 0, 1});
  for (int y = 0; y < kSidePx; ++y)
    for (int x = 0; x < kSidePx; ++x) {
      samples.at(x, y, 3) = alpha(x, y);
      for (int c = 0; c < 3; ++c)
        samples.at(x, y, c) = alpha(x, y) * const_cast<Samples&>(picture).at(x, y, c);
    }
  return samples;
}

TEST_F(PictureKinds, AlphaThatOutlinesASheetIsNoTree) {
  const Samples picture = paint(plain_ground({.97f, .95f, .9f}), kLeafPaint);
  const auto oval = [](int x, int y) {
    return std::hypot((x - 99.5) / 99, (y - 99.5) / 99) < 1 ? 1.0f : 0.0f;
  };
  const auto card = [](int x, int y) { return x > 3 && y > 3 && x < 196 && y < 196 ? 1.0f : 0.0f; };
  expect_tree_of(with_alpha(picture, oval), .96, .88);
  expect_tree_of(with_alpha(picture, card), .96, .88);
  EXPECT_THAT(read("a.png").left_out.front(), HasSubstr("sheet"));
}

TEST_F(PictureKinds, ADropShadowIsNoTree) {
  Samples shadowed = test::blank(kSidePx, kSidePx, {0, 0, 0, 0});
  for (int y = 0; y < kSidePx; ++y)
    for (int x = 0; x < kSidePx; ++x) {
      const bool tree = test::drawn_tree(x, y, kSidePx), shadow = test::drawn_tree(x - 8, y - 6, kSidePx);
      shadowed.at(x, y, 3) = tree ? 1 : shadow ? .7f : 0;
      if (tree) shadowed.at(x, y, 1) = .5f;
    }
  test::write_samples(folder_ / "a.png", shadowed);
  EXPECT_EQ(read("a.png").source_tree, test::drawn_tree_mask(kSidePx));
}

/// A GIF of two black colours, of which the first is transparent (GIF89a, §23 and appendix F): each code of
/// its LZW data stands for one pixel, as the table is cleared before it grows.
std::string transparent_gif(const Mask& mask) {
  std::string codes;
  unsigned bits = 0, held = 0;
  const auto add = [&](unsigned code) {
    bits |= code << held;
    for (held += 3; held >= 8; held -= 8, bits >>= 8) codes += static_cast<char>(bits & 0xff);
  };
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x) {
      if ((y * mask.width_px() + x) % 2 == 0) add(4);
      add(mask.get(x, y) ? 1 : 0);
    }
  add(5);
  codes += static_cast<char>(bits & 0xff);
  const std::string size = {static_cast<char>(mask.width_px()), 0, static_cast<char>(mask.height_px()), 0};
  std::string gif = "GIF89a" + size + std::string("\x80\0\0\0\0\0\0\0\0!\xf9\x04\x01\0\0\0\0,\0\0\0\0", 22) +
                    size + std::string("\0\x02", 2);
  for (std::size_t at = 0; at < codes.size(); at += 255) {
    const std::string block = codes.substr(at, 255);
    gif += static_cast<char>(block.size()) + block;
  }
  return gif + std::string("\0;", 2);
}

TEST_F(PictureKinds, AGifsAlphaIsRead) {
  const Mask tree = test::drawn_tree_mask(100);
  test::write_bytes(folder_ / "a.gif", transparent_gif(tree));
  EXPECT_EQ(read("a.gif").source_tree, tree);
}

TEST_F(PictureKinds, TransparentEverywhereIsCalledThat) {
  test::write_samples(folder_ / "a.png", test::blank(64, 64, {.3f, .3f, .3f, 0}));
  EXPECT_THAT(error_of("a.png", {}), HasSubstr("transparent everywhere"));
}

// --- several trees

TEST_F(PictureKinds, OfASheetInRowsOneTreeIsTaken) {
  Mask sheet(600, 600);
  for (int tree = 0; tree < 6; ++tree)
    for (int y = 0; y < 180; ++y)
      for (int x = 0; x < 120 + 8 * tree; ++x)
        if (x > 40 || y < 100) sheet.set(200 * (tree % 3) + 10 + x, 300 * (tree / 3) + 40 + y);
  write_mask_png(folder_ / "a.png", sheet);
  TargetOptions options{.size_px = kSidePx, .one_tree = true};
  EXPECT_EQ(read("a.png", options).faults.trees, 6);
  EXPECT_EQ(area_px(read("a.png", options).source_tree), 160u * 180 - 41u * 80) << "the last is the largest";
  options.hints.tree = 2;
  EXPECT_EQ(area_px(read("a.png", options).source_tree), 128u * 180 - 41u * 80);
  options.hints.tree = 7;
  EXPECT_THAT(error_of("a.png", options), HasSubstr("1 to 6"));
}

// --- hints

TEST_F(PictureKinds, HintsOutsideOfThePictureOrAgainstEachOtherAreRefused) {
  test::write_samples(folder_ / "a.png", paint(plain_ground(kWhitePaint), kLeafPaint));
  const auto refused = [&](auto change, const char* part) {
    TargetOptions options{.size_px = kSidePx, .one_tree = true};
    change(options);
    EXPECT_THAT(error_of("a.png", options), testing::AllOf(HasSubstr("got"), HasSubstr(part)));
  };
  refused([](TargetOptions& options) { options.hints.region = "100,100,101,50"; }, "200×200");
  refused([](TargetOptions& options) { options.hints.region = "1,2,3"; }, "LEFT,TOP");
  refused([](TargetOptions& options) { options.hints.tree_seeds = "200,5"; }, "200,5");
  refused([](TargetOptions& options) { options.hints.ground_seeds = "5"; }, "X,Y");
  refused([](TargetOptions& options) { options.hints.ground_color = "green"; }, "RRGGBB");
  refused([](TargetOptions& options) { options.hints.keep_marks = "persons"; }, "captions");
  refused([](TargetOptions& options) { options.hints.scale_bar = "20"; }, "PIXELS=METRES");
  refused([](TargetOptions& options) { options.hints.label = "7"; }, "label");
  refused([](TargetOptions& options) { options.hints.frame = 3; }, "frame 3");
  refused([](TargetOptions& options) { options.hints.tree = 1, options.one_tree = false; }, "all trees");
  refused([](TargetOptions& options) { options.hints.tree_seeds = options.hints.ground_seeds = "5,5"; },
          "5,5");
  refused(
      [](TargetOptions& options) {
        options.hints.ground_color = "#ffffff", options.separation.method = SeparationMethod::luminance;
      },
      "luminance");
}

TEST_F(PictureKinds, ASeedOfTheTreeKeepsWhatLooksLikeGround) {
  Samples samples = test::blank(kSidePx, kSidePx, {.9f, .9f, .9f});
  paint_box(samples, 60, 30, 140, 110, .3f);
  paint_box(samples, 90, 110, 110, 180, .3f);
  paint_box(samples, 80, 50, 120, 90, .9f);  // as light as the ground
  test::write_samples(folder_ / "a.png", samples);
  TargetOptions options{.size_px = kSidePx};
  options.separation.method = SeparationMethod::background;
  EXPECT_FALSE(read("a.png", options).source_tree.get(100, 70));
  options.hints.tree_seeds = "100,70";
  EXPECT_TRUE(read("a.png", options).source_tree.get(100, 70));
}

TEST_F(PictureKinds, ARegionHidesTheRest) {
  Samples samples = paint(plain_ground(kWhitePaint), kLeafPaint);
  paint_box(samples, 0, 100, 15, 190, 0);
  test::write_samples(folder_ / "a.png", samples);
  TargetOptions options{.size_px = kSidePx};
  options.hints.region = "20,0,180,200";
  expect_tree(read("a.png", options), .96, .88);
}

// --- the files

struct KnownPicture {
  const char* file;
  double least_iou;  ///< 0: it is refused, and the option is named
};

class DefectivePictures : public testing::TestWithParam<KnownPicture> {};

TEST_P(DefectivePictures, AreReadAsAPersonWould) {
  const fs::path folder = ESPALIER_SOURCE_DIR "/../shared/defects/pictures";
  const fs::path picture = folder / GetParam().file;
  if (!fs::exists(picture)) GTEST_SKIP() << picture << " is not there";
  if (GetParam().least_iou == 0) {
    try {
      read_target(picture);
      FAIL() << "was read";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("--label"));
    }
    return;
  }
  const Mask truth = read_target(folder / (picture.stem().string() + ".truth.png")).mask;
  const TargetPicture target = read_target(picture);
  EXPECT_GE(iou(target.mask, truth), GetParam().least_iou) << target.how;
}

INSTANTIATE_TEST_SUITE_P(
    Shared, DefectivePictures,
    testing::Values(KnownPicture{"a01_mask_0_1.png", .99}, KnownPicture{"a02_voc_tree_and_ground.png", 0},
                    KnownPicture{"a14_sky_and_ground.png", .93},
                    KnownPicture{"a14_sunset_silhouette.jpg", .93},
                    KnownPicture{"a15_scan_vignette.jpg", .93}, KnownPicture{"a17_black_frame.png", .93},
                    KnownPicture{"a17_caption_scalebar.png", .93}, KnownPicture{"a22_oval_vignette.png", .93},
                    KnownPicture{"b03_probability.png", .91}, KnownPicture{"b06_silver_birch_grey.png", .99},
                    KnownPicture{"b06_silver_birch_on_white.png", .99},
                    KnownPicture{"b07_transparent_black.gif", .99},
                    KnownPicture{"c02_figure_with_frame.png", .93}, KnownPicture{"c03_ground_line.png", .93}),
    [](const auto& info) {
      std::string name = fs::path(info.param.file).stem().string();
      return name;
    });

}  // namespace
}  // namespace espalier
