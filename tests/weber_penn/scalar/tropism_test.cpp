// Tropism [CH §3.2.1]: at each segment end the heading h turns by 10·|h × T| degrees about h × T, towards T.
// Its upward part pulls stems of level 2 and above alone.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/weber_penn/scalar/stem_walk.h>

namespace espalier {
namespace {

class TropicWalk : public StemVisitor {
 public:
  bool segment(const GrowingStem&, const Segment& segment) override {
    all.push_back(segment);
    return true;
  }
  void split(const GrowingStem&) override { FAIL() << "this stem does not split"; }
  std::vector<Segment> all;
};

/// The headings of the segments of a stem that lies along x and bends by nothing else.
std::vector<Vec3> headings(int level, Vec3 tropism) {
  WeberPennParameters p = weber_penn_parameters(weber_penn_table().defaults());
  p.curve_res[level] = 4;
  for (float* value : {&p.curve[level], &p.curve_back[level], &p.curve_v[level], &p.bend_v[level],
                       &p.seg_splits[level], &p.base_splits})
    *value = 0;
  p.tropism_x = tropism.x, p.tropism_y = tropism.y, p.tropism_z = tropism.z;
  GrowingStem stem;
  stem.level = level;
  stem.length_m = 4;
  stem.turtle.rotate_about({0, 1, 0}, 90);
  TropicWalk segments;
  walk_stem(stem, p, segments);
  std::vector<Vec3> all;
  for (const Segment& segment : segments.all) all.push_back(normalized(segment.end_m - segment.handle_in_m));
  return all;
}

TEST(Tropism, TurnsTheHeadingTowardsItByTenDegreesTimesTheirCrossProduct) {
  for (const Vec3 tropism : {Vec3{0, 0, 2}, Vec3{0, 0, -0.5f}, Vec3{0.3f, 1, 0.5f}}) {
    const std::vector<Vec3> got = headings(2, tropism);
    ASSERT_EQ(got.size(), 4u);
    Vec3 heading{1, 0, 0};
    for (std::size_t i = 0; i < got.size(); ++i) {
      EXPECT_LT(length(got[i] - heading), 1e-3f) << i;
      const Vec3 axis = cross(heading, tropism);
      const float angle = radians(10 * length(axis));
      const Vec3 towards = normalized(cross(normalized(axis), heading));  // at a right angle to it, to T
      heading = heading * std::cos(angle) + towards * std::sin(angle);
    }
    EXPECT_GT(dot(got[3], tropism), dot(got[0], tropism));
  }
}

TEST(Tropism, PullsUpwardsFromTheSecondLevelOnAndSidewaysOnAll) {
  for (const int level : {0, 1}) {
    EXPECT_NEAR(headings(level, {0, 0, 3}).back().z, 0, 1e-5f);
    EXPECT_GT(headings(level, {0, 3, 0}).back().y, 0.5f);
  }
}

}  // namespace
}  // namespace espalier
