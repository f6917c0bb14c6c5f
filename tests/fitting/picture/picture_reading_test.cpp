// What is read off a picture: the kinds of the bundled targets, and measures that do not depend on the size.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include <espalier/core/error.h>
#include <espalier/fitting/picture/picture_reading.h>
#include <espalier/image/reading/read_target.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/camera.h>
#include <espalier/render/scanlines/scanline_renderer.h>

namespace espalier {
namespace {

PictureReading reading_of(const std::string& name, int size_px = 128) {
  const std::filesystem::path file = std::filesystem::path(ESPALIER_SOURCE_DIR) / "targets" / (name + ".png");
  return read_picture(read_target(file, {.size_px = size_px}).mask);
}

struct KnownKind {
  const char* name;
  TreeKind kind;
};

class PictureKind : public testing::TestWithParam<KnownKind> {};

TEST_P(PictureKind, IsWhatAPersonSees) { EXPECT_EQ(reading_of(GetParam().name).kind, GetParam().kind); }

INSTANTIATE_TEST_SUITE_P(
    Targets, PictureKind,
    testing::Values(
        KnownKind{"oc_palm", TreeKind::palm}, KnownKind{"tr_palmtree2", TreeKind::palm},
        KnownKind{"reference_palm", TreeKind::palm}, KnownKind{"oc_rpg11", TreeKind::leafless},
        KnownKind{"tr_blandbirch", TreeKind::leafless}, KnownKind{"tr_crookedtree4", TreeKind::leafless},
        KnownKind{"tr_snowytree", TreeKind::leafless}, KnownKind{"snowy_tree", TreeKind::leafless},
        KnownKind{"fir", TreeKind::leafy}, KnownKind{"tr_birch", TreeKind::leafy},
        KnownKind{"oc_cypress", TreeKind::leafy}, KnownKind{"oc_orange", TreeKind::leafy},
        KnownKind{"reference_apple", TreeKind::leafy}, KnownKind{"reference_quaking_aspen", TreeKind::leafy},
        KnownKind{"reference_weeping_willow", TreeKind::leafy}, KnownKind{"oc_rpg01", TreeKind::leafy}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(PictureReading, MeasuresDoNotDependOnTheSizeOfTheMask) {
  for (const char* name : {"oc_cypress", "tr_birch", "oc_palm"}) {
    const PictureReading small = reading_of(name, 128), large = reading_of(name, 512);
    EXPECT_NEAR(small.trunk_width, large.trunk_width, 0.03) << name;
    EXPECT_NEAR(small.crown_base, large.crown_base, 0.06) << name;
    EXPECT_NEAR(small.crown_width, large.crown_width, 0.02) << name;
    EXPECT_NEAR(small.cover, large.cover, 0.05) << name;
  }
}

TEST(PictureReading, AFewThickLimbsAreATreeWithoutLeaves) {
  Mask mask(128, 128);
  const auto draw_limb = [&](int from_x, int from_y, int to_x, int to_y) {
    for (int step = 0; step <= 200; ++step)
      for (int dy = -4; dy <= 4; ++dy)
        for (int dx = -4; dx <= 4; ++dx)
          mask.set(from_x + step * (to_x - from_x) / 200 + dx, from_y + step * (to_y - from_y) / 200 + dy);
  };
  draw_limb(64, 120, 64, 70), draw_limb(64, 70, 10, 20), draw_limb(64, 70, 118, 30);
  const PictureReading reading = read_picture(mask);
  EXPECT_GT(reading.cover, 0.745) << "its gaps are too wide to be closed";
  EXPECT_EQ(reading.kind, TreeKind::leafless);
}

TEST(PictureReading, APorousCrownIsNoWinterTree) {
  Mask mask(128, 128);  // a ball of leaves that cover three fifths of it, on a trunk
  for (int y = 10; y < 120; ++y)
    for (int x = 0; x < 128; ++x) {
      const bool in_crown = (x - 64) * (x - 64) + (y - 55) * (y - 55) < 45 * 45;
      if (in_crown ? (x / 4 + 3 * (y / 4)) % 5 < 3 : y > 55 && std::abs(x - 64) < 4) mask.set(x, y);
    }
  const PictureReading reading = read_picture(mask);
  EXPECT_LT(reading.cover, 0.745);
  EXPECT_EQ(reading.kind, TreeKind::leafy);
}

/// The silhouette of a bundled species, in leaf or bare, as a fit sees it.
TreeKind kind_of_species(const std::string& name, Seed seed, bool in_leaf) {
  const Preset preset = load_preset(name);
  const Model& model = model_by_name(preset.model);
  ParameterValues values = preset.values;
  if (!in_leaf) values[model.table().index_of("leaf_blos_num")] = 0;
  Plant plant;
  model.generate(values, seed, {}, plant);
  Mask mask;
  make_scanline_renderer()->draw(plant, frame_bounds(bounds(plant), {}, 128, 128), mask);
  return read_picture(mask).kind;
}

/// Of the species without fronds, with seeds that no limit was chosen by. Few are read wrongly: the twigs of
/// the sphere tree and of the willow are as dense as leaves; acer, larch and cherry are open in leaf.
TEST(PictureReading, SpeciesInLeafAndBareAreToldApart) {
  std::string wrong;
  int trees = 0, mistakes = 0;
  for (const std::string& name : bundled_presets()) {
    if (load_preset(name).model != "weber_penn" || name.ends_with("palm")) continue;
    for (const Seed seed : {4, 5, 6})
      for (const bool in_leaf : {true, false}) {
        ++trees;
        if ((kind_of_species(name, seed, in_leaf) == TreeKind::leafy) == in_leaf) continue;
        ++mistakes;
        wrong += fmt::format("{} {} {}, ", name, seed, in_leaf ? "in leaf" : "bare");
      }
  }
  EXPECT_LT(mistakes, 0.12 * trees) << wrong;
  for (const char* clumps : {"cambridge_oak", "bamboo"})
    for (const Seed seed : {4, 5, 6})
      EXPECT_EQ(kind_of_species(clumps, seed, true), TreeKind::leafy) << clumps;
}

TEST(PictureReading, APoleHasNoCrown) {
  Mask mask(64, 64);
  for (int y = 4; y < 60; ++y) mask.set(30, y), mask.set(31, y);
  const PictureReading reading = read_picture(mask);
  EXPECT_NEAR(reading.trunk_width, 2.0 / 56, 1e-9);
  EXPECT_EQ(reading.crown_base, 1);
  EXPECT_FALSE(reading.touches_frame);
}

TEST(PictureReading, ATreeThatIsCutOffTouchesTheFrame) {
  Mask mask(64, 64);
  for (int y = 0; y < 60; ++y) mask.set(30, y);
  EXPECT_TRUE(read_picture(mask).touches_frame);
}

TEST(PictureReading, AnEmptyMaskIsRefused) { EXPECT_THROW(read_picture(Mask(32, 32)), InputError); }

TEST(PictureReading, BranchesOnTheGroundAreNoTrunk) {
  Mask mask(64, 64);
  for (int y = 4; y < 60; ++y)
    for (int x = 0; x < 64; ++x)
      if (std::abs(x - 32) <= 1 || (y < 57 && std::abs(x - 32) <= (y - 4) / 2)) mask.set(x, y);
  EXPECT_NEAR(read_picture(mask).trunk_width, 3.0 / 56, 1e-9);
  for (const int x : {5, 6, 58, 59}) mask.set(x, 58);  // tips beside it
  EXPECT_NEAR(read_picture(mask).trunk_width, 3.0 / 56, 1e-9);
}

}  // namespace
}  // namespace espalier
