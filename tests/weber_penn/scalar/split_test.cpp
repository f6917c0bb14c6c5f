// Dichotomous splits of a stem [Weber & Penn 95, §4.2]: the parts lean away from the stem by half of the
// split angle each, and pay the angle back in equal parts at the segment ends that follow.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/weber_penn/scalar/stem_walk.h>

namespace espalier {
namespace {

class SplitWalk : public StemVisitor {
 public:
  bool segment(const GrowingStem&, const Segment& segment) override {
    all.push_back(segment);
    return true;
  }
  void split(const GrowingStem& clone) override { clones.push_back(clone); }
  std::vector<Segment> all;
  std::vector<GrowingStem> clones;
};

/// An upright trunk of ten segments that splits in two after the third.
WeberPennParameters splitting(float split_angle_deg) {
  WeberPennParameters p = weber_penn_parameters(weber_penn_table().defaults());
  p.curve_res[0] = 10;
  p.base_size[0] = 0.3f;
  p.base_splits = 1;
  p.split_angle[0] = split_angle_deg;
  for (float* value : {&p.split_angle_v[0], &p.curve[0], &p.curve_back[0], &p.curve_v[0], &p.bend_v[0],
                       &p.seg_splits[0], &p.tropism_x, &p.tropism_y})
    *value = 0;
  return p;
}

GrowingStem trunk(Seed seed = 1) {
  GrowingStem stem;
  stem.key = root_key(seed);
  stem.length_m = 10;
  return stem;
}

SplitWalk split_walk(const GrowingStem& stem, const WeberPennParameters& p) {
  SplitWalk visitor;
  walk_stem(stem, p, visitor);
  return visitor;
}

Vec3 heading_of(const Segment& segment) { return normalized(segment.end_m - segment.handle_in_m); }

float between_deg(Vec3 a, Vec3 b) { return degrees(std::acos(std::fmin(1.f, dot(a, b)))); }

/// How the stem turns at the end of each of its segments but the last.
std::vector<float> turns_deg(const std::vector<Segment>& segments) {
  std::vector<float> turns;
  for (std::size_t i = 1; i < segments.size(); ++i)
    turns.push_back(between_deg(heading_of(segments[i - 1]), heading_of(segments[i])));
  return turns;
}

TEST(Split, TheStemLeansByHalfOfTheAngleAndPaysItBackInEqualParts) {
  const std::vector<float> turns = turns_deg(split_walk(trunk(), splitting(42)).all);
  ASSERT_EQ(turns.size(), 9u);
  for (std::size_t at = 1; at <= 9; ++at)  // the end of segment `at`
    EXPECT_NEAR(turns[at - 1], at < 3 ? 0 : at == 3 ? 21 : 42.0 / 7, 0.1) << at;
}

TEST(Split, WhatIsPaidBackTurnsTheStemTowardsWhereItCameFrom) {
  const std::vector<Segment> segments = split_walk(trunk(), splitting(42)).all;
  const Vec3 leaning = heading_of(segments[3]);
  EXPECT_NEAR(declination_deg(leaning), 21, 0.1);
  EXPECT_NEAR(declination_deg(heading_of(segments[6])), 21 - 3 * 6, 0.2);
  // Six parts of seven are paid by the last segment: 36 degrees back from 21, beyond the vertical.
  EXPECT_NEAR(declination_deg(heading_of(segments[9])), 36 - 21, 0.2);
  const Vec3 last = heading_of(segments[9]);
  EXPECT_LT(leaning.x * last.x + leaning.y * last.y, 0);
}

TEST(Split, ClonesLeanAndPayBackAsTheStemDoes) {
  const SplitWalk stem = split_walk(trunk(), splitting(42));
  ASSERT_EQ(stem.clones.size(), 1u);
  EXPECT_NEAR(declination_deg(stem.clones[0].turtle.forward), 21, 0.1);
  const std::vector<float> turns = turns_deg(split_walk(stem.clones[0], splitting(42)).all);
  ASSERT_EQ(turns.size(), 6u);
  for (const float turn : turns) EXPECT_NEAR(turn, 6, 0.1);
}

/// split_angle < 0: in the plane of the stem, nothing is paid back.
TEST(Split, FlatForksArePaidBackByNobody) {
  const SplitWalk stem = split_walk(trunk(), splitting(-42));
  const std::vector<float> turns = turns_deg(stem.all);
  for (std::size_t at = 1; at <= 9; ++at) EXPECT_NEAR(turns[at - 1], at == 3 ? 21 : 0, 0.1) << at;
  EXPECT_NEAR(between_deg(stem.clones[0].turtle.forward, heading_of(stem.all[3])), 42, 0.1);
}

/// The parts of a base split stand round the stem.
TEST(Split, PartsAtTheBaseAreSpreadEvenlyRoundTheStem) {
  WeberPennParameters p = splitting(42);
  p.base_splits = 3;
  const SplitWalk stem = split_walk(trunk(), p);
  ASSERT_EQ(stem.clones.size(), 3u);
  std::vector<Vec3> parts = {heading_of(stem.all[3])};
  for (const GrowingStem& clone : stem.clones) parts.push_back(clone.turtle.forward);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const float turn = std::atan2(parts[i].y, parts[i].x) - std::atan2(parts[i - 1].y, parts[i - 1].x);
    EXPECT_NEAR(std::fabs(std::remainder(degrees(turn), 360.f)), 90, 0.2) << i;
  }
}

/// [WP §4.2]: an angle that the stem already leans by is not leant again.
TEST(Split, TheAngleIsLessByTheDeclinationOfTheStem) {
  GrowingStem stem = trunk();
  stem.turtle.rotate_about({1, 0, 0}, 30);
  const std::vector<float> turns = turns_deg(split_walk(stem, splitting(42)).all);
  EXPECT_NEAR(turns[3], (42.0 - 30) / 7, 0.1);
  stem.turtle.rotate_about({1, 0, 0}, 30);
  EXPECT_NEAR(turns_deg(split_walk(stem, splitting(42)).all)[3], 0, 0.1);
}

}  // namespace
}  // namespace espalier
