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
using testing::HasSubstr;

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
