// Summaries of silhouettes: the same for a mirrored one, and what they are called.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include <espalier/core/error.h>
#include <espalier/core/random.h>
#include <espalier/fitting/posterior/simulations/oriented_runs.h>
#include <espalier/fitting/posterior/simulations/plant_simulator.h>
#include <espalier/fitting/posterior/simulations/silhouette_summaries.h>
#include <espalier/image/reading/read_target.h>
#include <espalier/models/models.h>

#include "support/prior_silhouettes.h"

namespace espalier {
namespace {

std::map<std::string, double> named(const Mask& mask) {
  std::map<std::string, double> summaries;
  const std::vector<double> values = summaries_of(mask);
  for (std::size_t i = 0; i < values.size(); ++i) summaries[summary_names()[i]] = values[i];
  return summaries;
}

/// 96 rows tall and 32 wide on a frame's base line, with a slit in the upper half.
Mask slit_post() {
  Mask mask(kSummaryFramePx, kSummaryFramePx);
  for (int y = 28; y < 124; ++y)
    for (int x = 48; x < 80; ++x)
      if (y >= 76 || x < 60 || x >= 68) mask.set(x, y);
  return mask;
}

Mask mirrored(const Mask& mask) {
  Mask result(mask.width_px(), mask.height_px());
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      if (mask.get(x, y)) result.set(mask.width_px() - 1 - x, y);
  return result;
}

Mask plant_mask(std::uint64_t i) { return silhouette_of_prior(5, i); }

TEST(SilhouetteSummaries, HaveEachANameOfItsOwn) {
  const std::set<std::string> names(summary_names().begin(), summary_names().end());
  EXPECT_EQ(names.size(), summary_names().size());
  EXPECT_EQ(summaries_of(slit_post()).size(), names.size());
}

TEST(SilhouetteSummaries, SayHowWideHowFullAndInHowManyPiecesAPostIs) {
  const auto summaries = named(slit_post());
  EXPECT_NEAR(summaries.at("width 01"), 32.0 / 96, 1e-9);
  EXPECT_NEAR(summaries.at("width 16"), 32.0 / 96, 1e-9);
  EXPECT_NEAR(summaries.at("cover 01"), 24.0 / 32, 1e-9);
  EXPECT_NEAR(summaries.at("cover 16"), 1, 1e-9);
  EXPECT_NEAR(summaries.at("pieces 01"), std::log1p(2), 1e-9);
  EXPECT_NEAR(summaries.at("pieces 16"), std::log1p(1), 1e-9);
  EXPECT_NEAR(summaries.at("area"), (32.0 * 96 - 8 * 48) / 96 / 96, 1e-9);
  EXPECT_NEAR(summaries.at("offset 1"), 0, 1e-9);
  EXPECT_NEAR(summaries.at("upright boundary 1"), std::log1p(4 * 24.0 / 96), 1e-9);
  EXPECT_NEAR(summaries.at("with gaps filled within 1 px"), 1, 1e-3);  // the corner at the slit's end
  EXPECT_GT(summaries.at("with gaps filled within 5 px"), 1.1);        // the slit is 8 wide
  EXPECT_GT(summaries.at("left without pieces within 5 px"), 0.9);     // the posts are 12 wide
  EXPECT_LT(summaries.at("left without pieces within 8 px"), 0.7);
}

TEST(SilhouetteSummaries, AreTheSameForAMirroredTree) {
  for (std::uint64_t i = 0; i < 12; ++i) {
    const Mask mask = plant_mask(i);
    const auto summaries = named(mask), other = named(mirrored(mask));
    for (const auto& [name, value] : summaries) EXPECT_NEAR(other.at(name), value, 1e-6) << name;
  }
}

/// A bar that rises away from the foot on either side, three pixels thick measured across the rows.
Mask rising_bars() {
  Mask mask(kSummaryFramePx, kSummaryFramePx);
  for (int i = 0; i < 40; ++i)
    for (int thick = 0; thick < 3; ++thick) {
      mask.set(66 + i, 100 - i - thick);
      mask.set(127 - 66 - i, 100 - i - thick);
    }
  return mask;
}

TEST(SilhouetteSummaries, RunsTellBarsThatRiseOutwardFromThoseThatRiseInward) {
  const auto summaries = named(rising_bars());
  for (int tier = 1; tier <= 4; ++tier) {
    const std::string place = fmt::format("5 px pieces {}", tier);
    EXPECT_GT(summaries.at("outward " + place), 0.03) << tier;
    for (const char* direction : {"inward ", "level ", "upright "})
      EXPECT_EQ(summaries.at(direction + place), 0) << direction << tier;
  }
  EXPECT_GT(summaries.at("level 5 px gaps 1"), 0.5);
  EXPECT_GT(summaries.at("upright 3 px pieces 1"), 0);  // as thick as the bars
}

TEST(SilhouetteSummaries, RunsAreThoseOfAtLeastTheirLength) {
  Mask mask(kSummaryFramePx, kSummaryFramePx);
  for (int x = 60; x < 67; ++x) mask.set(x, 10);  // seven, over the border of two words
  for (int x = 20; x < 23; ++x) mask.set(x, 10);
  EXPECT_EQ(area_px(on_runs(mask, 3, 1, 0)), 10u);
  EXPECT_EQ(area_px(on_runs(mask, 4, 1, 0)), 7u);
  EXPECT_EQ(area_px(on_runs(mask, 4, -1, 0)), 7u);
  EXPECT_EQ(area_px(on_runs(mask, 8, 1, 0)), 0u);
  EXPECT_EQ(area_px(on_runs(mask, 2, 0, 1)), 0u);
  EXPECT_EQ(area_px(on_runs(mask, 2, -1, -1)), 0u);
}

TEST(SilhouetteSummaries, RingsTellAHollowPostAndStepsARoughOne) {
  const auto hollow = named(slit_post());
  EXPECT_LT(hollow.at("ring 1 cover 1"), 0.1);  // the slit is a quarter of the width, in the middle
  EXPECT_GT(hollow.at("ring 4 cover 1"), 0.9);
  EXPECT_GT(hollow.at("ring 1 cover 4"), 0.9);
  EXPECT_NEAR(hollow.at("steps 2"), 0, 1e-9);
  EXPECT_NEAR(hollow.at("width spread 03"), 0, 1e-9);
  Mask rough = slit_post();
  for (int y = 52; y < 76; y += 2) rough.set(46, y);  // two pixels out and in again, in the second tier
  const auto stepped = named(rough);
  EXPECT_NEAR(stepped.at("steps 2"), std::log1p(24 * 2.0 / 25), 1e-9);
  EXPECT_NEAR(stepped.at("steps 1"), 0, 1e-9);
  EXPECT_NEAR(stepped.at("width spread 06"), 1.0 / 96, 1e-9);
}

TEST(SilhouetteSummaries, OfALargePictureAreNearlyThoseOfASmallOne) {
  const Mask post = framed_for_summaries(slit_post());
  Mask large(3 * kSummaryFramePx, 3 * kSummaryFramePx);
  for (int y = 0; y < large.height_px(); ++y)
    for (int x = 0; x < large.width_px(); ++x)
      if (slit_post().get(x / 3, y / 3)) large.set(x, y);
  EXPECT_LE(differing_px(framed_for_summaries(large), post), 130u);  // an edge
}

TEST(SilhouetteSummaries, FramingKeepsTwigsThinnerThanAPixel) {
  Mask large(1024, 1024);
  for (int y = 40; y < 1000; ++y)
    for (int x = 100; x < 900; x += 40)
      for (int width = 0; width < 3; ++width) large.set(x + width, y);  // a third of a framed pixel
  EXPECT_THROW(frame_mask(large, kSummaryFramePx), InputError);  // by the halves of pixels they are gone
  const auto covered = static_cast<double>(area_px(framed_for_summaries(large)));
  EXPECT_NEAR(covered / (20 * 118), 3 / 8.14, 0.15);
}

TEST(SilhouetteSummaries, OfNothingAreRefused) {
  EXPECT_THROW(summaries_of(Mask(128, 128)), InputError);
  EXPECT_THROW(framed_for_summaries(Mask(64, 64)), InputError);
}

}  // namespace
}  // namespace espalier
