// Fits of pictures that are no clean picture of one tree: each ends with a tree, and says what it did.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <espalier/fitting/run/fit.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/image/pictures/picture.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

struct Block {
  int left, top, right, bottom;
};

fs::path picture_of(const std::string& name, const std::vector<Block>& blocks) {
  Mask mask(128, 128);
  for (const Block& block : blocks)
    for (int y = block.top; y < block.bottom; ++y)
      for (int x = block.left; x < block.right; ++x) mask.set(x, y);
  const fs::path path = fresh_folder("picture_" + name) / (name + ".png");
  write_mask_png(path, mask);
  return path;
}

constexpr Block kCrown{44, 10, 84, 70}, kTrunk{60, 70, 68, 120};

FitRecord record_of(const fs::path& picture, bool train = false) {
  FitRecord record;
  record.views = {{picture, {}}};
  record.target.size_px = 32;
  record.budget = {.evaluations = 20, .seconds = 0};
  record.growth = {150, 600};
  record.start = "palm";
  record.train_to_target = train;
  return record;
}

struct Fitted {
  nlohmann::json summary;
  std::vector<std::string> warnings;
};

Fitted fitted(const std::string& name, const FitRecord& record) {
  Fitted result;
  FitExecution options;
  options.on_warning = [&](const std::string& text) { result.warnings.push_back(text); };
  const fs::path run = fresh_folder(name) / "run";
  fit(record, run, options);
  result.summary = nlohmann::json::parse(read_text_file(run / "summary.json"));
  return result;
}

TEST(BadPicture, ASoundOneGivesNoWarning) {
  const Fitted sound = fitted("sound", record_of(picture_of("sound", {kCrown, kTrunk}), true));
  EXPECT_TRUE(sound.warnings.empty());
  EXPECT_FALSE(sound.summary.contains("warnings"));
  EXPECT_EQ(sound.summary["trained_to_target"], true);
}

/// A crown whose left half is as dark as the ground is light, and whose right half is neither.
fs::path half_told_picture() {
  Picture picture(128, 128, {255, 255, 255});
  for (int y = 10; y < 120; ++y)
    for (int x = y < 70 ? 44 : 60; x < (y < 70 ? 84 : 68); ++x)
      picture.at(x, y) = x < 64 ? Rgb{0, 0, 0} : Rgb{140, 140, 140};
  const fs::path path = fresh_folder("half_told") / "tree.png";
  write_png(path, picture);
  return path;
}

TEST(BadPicture, HowSureItsReadingIsStandsInTheSummary) {
  const Fitted sure = fitted("sure", record_of(picture_of("sure", {kCrown, kTrunk}))),
               doubtful = fitted("doubtful", record_of(half_told_picture()));
  EXPECT_EQ(sure.summary["confidence"], nlohmann::json({1.0}));
  EXPECT_LT(doubtful.summary["confidence"][0], 1);
}

TEST(BadPicture, CutOffAtTheFrameItIsFittedWithAWarning) {
  const Fitted cut = fitted("cut", record_of(picture_of("cut", {{44, 0, 128, 70}, kTrunk})));
  ASSERT_EQ(cut.warnings.size(), 1u);
  EXPECT_THAT(cut.warnings[0], HasSubstr("right and the upper edge"));
  EXPECT_EQ(cut.summary["warnings"], cut.warnings);
}

TEST(BadPicture, OfSeveralTreesTheLargestIsFitted) {
  const std::vector<Block> tree{kCrown, kTrunk};
  const Block other_crown{4, 40, 28, 80}, other_trunk{14, 80, 18, 120};
  FitRecord record = record_of(picture_of("two", {kCrown, kTrunk, other_crown, other_trunk})),
            alone = record_of(picture_of("alone", tree));
  const Fitted two = fitted("two", record);
  ASSERT_EQ(two.warnings.size(), 1u);
  EXPECT_THAT(two.warnings[0], HasSubstr("2 trees in the picture: the largest is fitted"));
  make_task(record), make_task(alone);
  EXPECT_EQ(record.target_hash, alone.target_hash);
  FitRecord all = record_of(record.views[0].picture);
  all.target.one_tree = false;
  const FitTask task = make_task(all);
  EXPECT_THAT(task.warnings.at(0), HasSubstr("fitted as one"));
  EXPECT_NE(all.target_hash, alone.target_hash);
}

TEST(BadPicture, AKindThatItDoesNotShowIsFittedWithAWarning) {
  FitRecord record = record_of(fs::path(ESPALIER_SOURCE_DIR) / "targets" / "tr_crookedtree4.png");
  record.start = "auto";
  record.kind = KindChoice::automatic;
  const Fitted as_seen = fitted("bare", record);
  EXPECT_THAT(as_seen.warnings, Not(Contains(HasSubstr("as told"))));
  EXPECT_EQ(as_seen.summary["kind"], "leafless");
  record.kind = KindChoice::leafy;
  const Fitted as_told = fitted("bare_leafy", record);
  EXPECT_THAT(as_told.warnings,
              Contains(HasSubstr("its tree looks leafless, and is fitted as leafy, as told")));
  EXPECT_EQ(as_told.summary["kind"], "leafy");
  EXPECT_THAT(as_told.summary["labels"]["in_doubt"], HasSubstr("leaves in the crown"));
}

/// Crown and trunk of these colours on white.
fs::path coloured_picture(const std::string& name, Rgb crown, Rgb trunk) {
  Picture picture(128, 128, {255, 255, 255});
  const auto paint = [&](const Block& block, Rgb color) {
    for (int y = block.top; y < block.bottom; ++y)
      for (int x = block.left; x < block.right; ++x) picture.at(x, y) = color;
  };
  paint(kCrown, crown);
  paint(kTrunk, trunk);
  const fs::path path = fresh_folder("picture_" + name) / (name + ".png");
  write_png(path, picture);
  return path;
}

TEST(BadPicture, WhereColoursSayNothingTheSummarySaysWhatIsExpectedInstead) {
  const std::pair<const char*, Rgb> cases[] = {
      {"brown", {90, 64, 40}}, {"grey", {128, 128, 128}}, {"pale", {205, 205, 205}}};
  for (const auto& [name, color] : cases) {
    FitRecord record = record_of(coloured_picture(name, color, color));
    record.kind = KindChoice::automatic;
    record.start = "apple";
    const nlohmann::json summary = fitted(name, record).summary;
    EXPECT_EQ(summary["kind"], "leafy") << name;
    EXPECT_EQ(summary["labels"]["how"], "the colours do not tell leaves from wood") << name;
    EXPECT_THAT(summary["labels"]["in_doubt"], HasSubstr("leaves in the crown")) << name;
  }
}

TEST(BadPicture, WhiteOnWhiteIsRefused) {
  constexpr Rgb kWhite{255, 255, 255};
  EXPECT_THROW(fitted("white", record_of(coloured_picture("white", kWhite, kWhite))), InputError);
}

TEST(BadPicture, WithoutRoomForATrunkTheTreeIsNotTrained) {
  const std::vector<Block> arch{{30, 10, 98, 70}, {30, 70, 40, 120}, {88, 70, 98, 120}};
  const Fitted free = fitted("arch", record_of(picture_of("arch", arch)));
  EXPECT_TRUE(free.warnings.empty());
  const Fitted trained = fitted("arch_trained", record_of(picture_of("arch", arch), true));
  ASSERT_EQ(trained.warnings.size(), 1u);
  EXPECT_THAT(trained.warnings[0], HasSubstr("no room for a trunk"));
  EXPECT_EQ(trained.summary["trained_to_target"], false);
  EXPECT_EQ(trained.summary["fitness"], free.summary["fitness"]);
}

}  // namespace
}  // namespace espalier
