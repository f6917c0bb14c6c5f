#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include <espalier/core/error.h>
#include <espalier/image/measures/compare.h>
#include <espalier/image/measures/objective.h>

#include "support/random_masks.h"

namespace espalier {
namespace {

using test::draw_mask;
using test::draw_pair;
using test::random_mask;

using Measure = double (*)(const Mask&, const Mask&);
constexpr Measure kSimilarities[] = {pixel_accuracy, iou, dice, tolerant_iou, outline_iou};
constexpr Measure kMeasures[] = {pixel_accuracy, iou, dice, tolerant_iou, outline_iou, truncated_distance};

// --- laws of all measures

RC_GTEST_PROP(Compare, SimilaritiesOfIdenticalMasksAreOne, ()) {
  const Mask mask = draw_mask(150);
  for (const Measure similarity : kSimilarities) RC_ASSERT(similarity(mask, mask) == 1.0);
}

RC_GTEST_PROP(Compare, DistanceOfIdenticalMasksIsZero, ()) {
  const Mask mask = draw_mask(150);
  RC_ASSERT(truncated_distance(mask, mask) == 0.0);
}

RC_GTEST_PROP(Compare, MeasuresAreSymmetric, ()) {
  const auto [a, b] = draw_pair(150);
  for (const Measure measure : kMeasures) RC_ASSERT(measure(a, b) == measure(b, a));
}

RC_GTEST_PROP(Compare, MeasuresAreBounded, ()) {
  const auto [a, b] = draw_pair(150);
  for (const Measure measure : kMeasures) {
    RC_ASSERT(measure(a, b) >= 0.0);
    RC_ASSERT(measure(a, b) <= 1.0);
  }
}

TEST(Compare, TwoEmptyMasksAreIdentical) {
  const Mask empty(70, 50);
  for (const Measure similarity : kSimilarities) EXPECT_EQ(similarity(empty, empty), 1.0);
  EXPECT_EQ(truncated_distance(empty, empty), 0.0);
}

TEST(Compare, AnEmptyMaskIsWorstAgainstAnyOther) {
  const Mask empty(70, 50);
  Mask dot(70, 50);
  dot.set(30, 30);
  for (const Measure similarity : std::initializer_list<Measure>{iou, dice, tolerant_iou, outline_iou})
    EXPECT_EQ(similarity(empty, dot), 0.0);
  EXPECT_EQ(truncated_distance(empty, dot), 1.0);
}

TEST(Compare, MasksOfDifferentSizesAreRefused) {
  for (const Measure measure : kMeasures) {
    EXPECT_THROW(measure(Mask(64, 64), Mask(65, 64)), InternalError);
    EXPECT_THROW(measure(Mask(64, 64), Mask(64, 65)), InternalError);
  }
}

// --- each measure against its formula, a pixel at a time

struct PlainCounts {
  double all = 0, in_a = 0, in_b = 0, in_both = 0, in_either = 0;
};

PlainCounts count_pixel_by_pixel(const Mask& a, const Mask& b) {
  PlainCounts n;
  for (int y = 0; y < a.height_px(); ++y)
    for (int x = 0; x < a.width_px(); ++x) {
      n.all += 1;
      n.in_a += a.get(x, y);
      n.in_b += b.get(x, y);
      n.in_both += a.get(x, y) && b.get(x, y);
      n.in_either += a.get(x, y) || b.get(x, y);
    }
  return n;
}

RC_GTEST_PROP(Compare, CountingMeasuresEqualTheirFormulas, ()) {
  const auto [a, b] = draw_pair(150);
  const PlainCounts n = count_pixel_by_pixel(a, b);
  RC_PRE(n.in_either > 0);
  RC_ASSERT(std::fabs(pixel_accuracy(a, b) - (1 - (n.in_either - n.in_both) / n.all)) < 1e-12);
  RC_ASSERT(std::fabs(iou(a, b) - n.in_both / n.in_either) < 1e-12);
  RC_ASSERT(std::fabs(dice(a, b) - 2 * n.in_both / (n.in_a + n.in_b)) < 1e-12);
}

double tolerant_iou_pixel_by_pixel(const Mask& a, const Mask& b) {
  double shared = 0, covered = 0;
  for (int top = 0; top < a.height_px(); top += 8)
    for (int left = 0; left < a.width_px(); left += 8) {
      double in_a = 0, in_b = 0;
      for (int y = top; y < std::min(top + 8, a.height_px()); ++y)
        for (int x = left; x < std::min(left + 8, a.width_px()); ++x) {
          in_a += a.get(x, y);
          in_b += b.get(x, y);
        }
      shared += std::min(in_a, in_b);
      covered += std::max(in_a, in_b);
    }
  return covered == 0 ? 1 : shared / covered;
}

RC_GTEST_PROP(Compare, TolerantIouEqualsItsFormula, ()) {
  const auto [a, b] = draw_pair(150);
  RC_ASSERT(std::fabs(tolerant_iou(a, b) - tolerant_iou_pixel_by_pixel(a, b)) < 1e-12);
}

TEST(Compare, TolerantIouIsBlindInsideABlock) {
  Mask a(64, 64), b(64, 64);
  a.set(16, 24);
  b.set(23, 31);
  EXPECT_EQ(iou(a, b), 0.0);
  EXPECT_EQ(tolerant_iou(a, b), 1.0);
}

/// The ball of radius n of the octagonal distance is a diamond of ceil(n/2) dilated by a square of
/// floor(n/2).
int octagonal_distance(int dx, int dy) {
  for (int n = 0;; ++n) {
    const int square = n / 2, diamond = n - square;
    if (std::max(0, std::abs(dx) - square) + std::max(0, std::abs(dy) - square) <= diamond) return n;
  }
}

/// The distance of the picture's interior: paths of the dilations cannot leave it, and need not.
double mean_distance_pixel_by_pixel(const Mask& over, const Mask& from, int limit_px) {
  double sum = 0, count = 0;
  for (int y = 0; y < over.height_px(); ++y)
    for (int x = 0; x < over.width_px(); ++x) {
      if (!over.get(x, y)) continue;
      int nearest = limit_px;
      for (int v = 0; v < from.height_px(); ++v)
        for (int u = 0; u < from.width_px(); ++u)
          if (from.get(u, v)) nearest = std::min(nearest, octagonal_distance(x - u, y - v));
      sum += nearest;
      count += 1;
    }
  return sum / count;
}

RC_GTEST_PROP(Compare, TruncatedDistanceEqualsABruteForceSearch, ()) {
  const int width = *rc::gen::inRange(60, 90), height = *rc::gen::inRange(20, 70);
  const auto seed = *rc::gen::arbitrary<Seed>();
  const Mask a = random_mask(width, height, *rc::gen::inRange(1, 4), seed);
  const Mask b = random_mask(width, height, *rc::gen::inRange(1, 4), seed + 1);
  RC_PRE(area_px(a) > 0 && area_px(b) > 0);
  const int limit = distance_limit_px(std::max(width, height));
  const double expected =
      (mean_distance_pixel_by_pixel(a, b, limit) + mean_distance_pixel_by_pixel(b, a, limit)) / (2 * limit);
  RC_ASSERT(std::fabs(truncated_distance(a, b) - expected) < 1e-12);
}

TEST(Compare, OctagonalDistanceIsNearTheEuclideanOne) {
  for (int dx = 0; dx <= 16; ++dx)
    for (int dy = 0; dy <= 16; ++dy) {
      const double euclidean = std::hypot(dx, dy);
      if (euclidean < 8 || euclidean > 16) continue;
      EXPECT_NEAR(octagonal_distance(dx, dy) / euclidean, 1.0, 0.12) << dx << ", " << dy;
    }
}

TEST(Compare, DistanceGrowsWithTheGapAndIsTruncated) {
  Mask a(128, 128);
  a.set(10, 64);
  double previous = -1;
  for (int gap = 0; gap <= 8; ++gap) {
    Mask b(128, 128);
    b.set(10 + gap, 64);
    EXPECT_GT(truncated_distance(a, b), previous);
    previous = truncated_distance(a, b);
  }
  EXPECT_EQ(previous, 1.0);
  Mask far(128, 128);
  far.set(100, 64);
  EXPECT_EQ(truncated_distance(a, far), 1.0);
}

// --- outlines

TEST(Compare, OutlineIouIgnoresHolesAndGapsBetweenLeaves) {
  Mask solid(256, 256), grid(256, 256);
  for (int y = 64; y < 192; ++y)
    for (int x = 64; x < 192; ++x) {
      solid.set(x, y);
      grid.set(x, y, x % 4 == 0 || y % 4 == 0 || x == 191 || y == 191);
    }
  EXPECT_LT(iou(solid, grid), 0.5);
  EXPECT_EQ(outline_iou(solid, grid), 1.0);
}

TEST(Compare, OutlinesFillHolesTooWideToClose) {
  Mask solid(256, 256), ring(256, 256);
  for (int y = 64; y < 192; ++y)
    for (int x = 64; x < 192; ++x) {
      solid.set(x, y);
      ring.set(x, y, x < 70 || x >= 186 || y < 70 || y >= 186);
    }
  EXPECT_EQ(outline_of(ring), outline_of(solid));
}

RC_GTEST_PROP(Compare, OutlineHoldsTheMask, ()) {
  const Mask mask = draw_mask(150);
  const Mask outline = outline_of(mask);
  RC_ASSERT(test::is_subset(mask, outline));
}

// --- prepared targets and objectives

RC_GTEST_PROP(PreparedTarget, GivesTheSameBitsAsTheMask, ()) {
  const auto [a, b] = draw_pair(200);
  const MaskMetrics prepared = compare_masks(a, PreparedTarget(b));
  RC_ASSERT(prepared["pixel_accuracy"] == pixel_accuracy(a, b));
  RC_ASSERT(prepared["iou"] == iou(a, b));
  RC_ASSERT(prepared["dice"] == dice(a, b));
  RC_ASSERT(prepared["tolerant_iou"] == tolerant_iou(a, b));
  RC_ASSERT(prepared["outline_iou"] == outline_iou(a, b));
  RC_ASSERT(prepared["gap_iou"] == gap_iou(a, b));
  RC_ASSERT(prepared["truncated_distance"] == truncated_distance(a, b));
}

RC_GTEST_PROP(MaskObjective, EachTermIsItsMeasureTurnedToZeroIsBest, ()) {
  const auto [a, b] = draw_pair(150);
  const auto value = [&, a = a, b = b](const char* text) {
    return dissimilarity(parse_objective(text), a, b);
  };
  RC_ASSERT(value("pixel_difference") == 1 - pixel_accuracy(a, b));
  RC_ASSERT(value("pixel_accuracy") == 1 - pixel_accuracy(a, b));
  RC_ASSERT(value("iou") == 1 - iou(a, b));
  RC_ASSERT(value("dice") == 1 - dice(a, b));
  RC_ASSERT(value("tolerant_iou") == 1 - tolerant_iou(a, b));
  RC_ASSERT(value("outline_iou") == 1 - outline_iou(a, b));
  RC_ASSERT(value("truncated_distance") == truncated_distance(a, b));
}

RC_GTEST_PROP(MaskObjective, SumsAreWeightedMeans, ()) {
  const auto [a, b] = draw_pair(100);
  const double expected = 0.25 * (1 - iou(a, b)) + 0.75 * truncated_distance(a, b);
  const double got = dissimilarity(parse_objective("1*iou + 3*truncated_distance"), a, b);
  RC_ASSERT(std::fabs(got - expected) < 1e-12);
}

TEST(MaskObjective, TextGoesThereAndBack) {
  for (const char* text : {"iou", "0.5*truncated_distance+0.5*iou", "2*dice + tolerant_iou",
                           "1e+2*iou+1e-1*dice", "0.1*iou+0.2*dice+0.3*outline_iou"}) {
    const MaskObjective once = parse_objective(text), twice = parse_objective(to_string(once));
    ASSERT_EQ(once.terms.size(), twice.terms.size()) << text;
    for (std::size_t i = 0; i < once.terms.size(); ++i) {
      EXPECT_EQ(once.terms[i].name, twice.terms[i].name);
      EXPECT_EQ(once.terms[i].weight, twice.terms[i].weight) << text;
    }
  }
}

class BadObjective : public testing::TestWithParam<const char*> {};
TEST_P(BadObjective, IsRefusedInOneLine) {
  try {
    parse_objective(GetParam());
    FAIL() << "accepted '" << GetParam() << "'";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("objective"), std::string::npos);
  }
}
INSTANTIATE_TEST_SUITE_P(Texts, BadObjective,
                         testing::Values("", "iuo", "iou+", "0*iou", "-1*iou", "nan*iou", "inf*iou",
                                         "1e999*iou", "x*iou", "0.5*", "iou iou", "0.5*iou*dice",
                                         "1e308*iou+1e308*dice"));

}  // namespace
}  // namespace espalier
