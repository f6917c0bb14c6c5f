// Where children of a stem point [Weber & Penn 95, §4.3; CH §3.2.1 Branch Distribution]: down_angle away from
// the parent, rotate about it from one to the next, and how a leaf's bend turns it [WP §4.9].
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/weber_penn/scalar/children.h>
#include <espalier/weber_penn/scalar/leaf_placement.h>
#include <espalier/weber_penn/table/shape_ratio.h>

namespace espalier {
namespace {

constexpr float kParentM = 8;

/// A straight upright stem of one segment that bears about forty children.
WeberPennParameters bearing() {
  WeberPennParameters p = weber_penn_parameters(weber_penn_table().defaults());
  p.curve_res[0] = 1;
  p.base_size[0] = 0.2f;
  p.branches[1] = 40;
  p.branch_dist[1] = 0;
  p.rotate[1] = 140;
  p.rotate_v[1] = 0;
  p.down_angle[1] = 50;
  p.down_angle_v[1] = 0;
  return p;
}

std::vector<ChildSite> sites(const WeberPennParameters& p, Seed seed = 1) {
  GrowingStem stem;
  stem.key = root_key(seed);
  stem.length_m = kParentM;
  stem.radius_m = 0.1f;
  Segment segment;
  segment.handle_out_m = {0, 0, kParentM / 3};
  segment.handle_in_m = {0, 0, 2 * kParentM / 3};
  segment.end_m = {0, 0, kParentM};
  segment.z_end = 1;
  segment.end.position_m = segment.end_m;
  ChildPlacer placer(stem, ChildPlacer::Bears::stems, p);
  placer.begin(stem, segment);
  std::vector<ChildSite> all;
  for (ChildSite site; placer.next(site);) all.push_back(site);
  return all;
}

float azimuth_deg(Vec3 v) { return degrees(std::atan2(v.y, v.x)); }

/// From each child to the next, -180 to 180.
std::vector<float> turns_deg(const std::vector<ChildSite>& children) {
  std::vector<float> turns;
  for (std::size_t i = 1; i < children.size(); ++i)
    turns.push_back(
        std::remainder(azimuth_deg(children[i].outward) - azimuth_deg(children[i - 1].outward), 360.f));
  return turns;
}

TEST(Children, GoRoundTheirParentByRotate) {
  for (const float rotate : {77.f, 140.f}) {
    WeberPennParameters p = bearing();
    p.rotate[1] = rotate;
    const std::vector<float> turns = turns_deg(sites(p));
    ASSERT_GT(turns.size(), 20u);
    for (const float turn : turns) EXPECT_NEAR(turn, turns[0], 0.1);
    EXPECT_NEAR(std::fabs(turns[0]), rotate, 0.1);
  }
}

/// rotate < 0: on alternate sides, |rotate| from the downward direction.
TEST(Children, AlternateWhereRotateIsNegative) {
  WeberPennParameters p = bearing();
  p.rotate[1] = -70;
  const std::vector<float> turns = turns_deg(sites(p));
  for (std::size_t i = 0; i < turns.size(); ++i) EXPECT_NEAR(std::fabs(turns[i]), 140, 0.1) << i;
  EXPECT_LT(turns[0] * turns[1], 0);
}

TEST(Children, VaryTheirRotationByUpToRotateV) {
  WeberPennParameters p = bearing();
  p.rotate_v[1] = 30;
  float least = 360, most = 0;
  for (Seed seed = 0; seed < 30; ++seed)
    for (const float turn : turns_deg(sites(p, seed)))
      least = std::min(least, std::fabs(turn)), most = std::max(most, std::fabs(turn));
  EXPECT_NEAR(least, 110, 3);
  EXPECT_NEAR(most, 170, 3);
}

TEST(Children, LeanAwayByTheirDownAngle) {
  for (const ChildSite& site : sites(bearing())) {
    EXPECT_NEAR(declination_deg(site.turtle.forward), 50, 0.1);
    EXPECT_GT(dot(site.turtle.forward, site.outward), 0.7f);
  }
}

TEST(Children, VaryTheirDownAngleByUpToDownAngleV) {
  WeberPennParameters p = bearing();
  p.down_angle_v[1] = 20;
  float least = 180, most = 0;
  for (Seed seed = 0; seed < 30; ++seed)
    for (const ChildSite& site : sites(p, seed)) {
      least = std::min(least, declination_deg(site.turtle.forward));
      most = std::max(most, declination_deg(site.turtle.forward));
    }
  EXPECT_NEAR(least, 30, 1);
  EXPECT_NEAR(most, 70, 1);
}

/// [WP §4.3]: down_angle_v < 0 changes the angle along the parent by the conical shape; then it varies by a
/// tenth.
TEST(Children, ChangeTheirDownAngleAlongTheParentWhereDownAngleVIsNegative) {
  WeberPennParameters p = bearing();
  p.down_angle_v[1] = -40;
  for (const ChildSite& site : sites(p)) {
    const float ratio = (kParentM - site.offset_m) / (kParentM * 0.8f);
    const float shaped = 50 - 40 * (1 - 2 * (0.2f + 0.8f * ratio));
    EXPECT_NEAR(declination_deg(site.turtle.forward), shaped, 0.1 * std::fabs(shaped) + 0.1);
  }
}

/// The azimuth of a leaf's normal against that of its place, about the z axis: -180 to 180.
float facing_deg(float leaf_bend) {
  WeberPennParameters p = bearing();
  p.leaf_bend = leaf_bend;
  GrowingStem stem;
  stem.tree.scale_m = p.g_scale;
  ChildSite site;
  site.turtle.position_m = {2, 1, 3};
  site.turtle.rotate_about({0, 1, 0}, 40);
  site.turtle.roll_right(50);
  Leaves leaves;
  place_leaf(stem, site, p, leaves);
  const Vec3 normal = cross(leaves.side[0], leaves.axis[0]);
  return std::remainder(azimuth_deg(leaves.position_m[0]) - azimuth_deg(normal), 360.f);
}

TEST(LeafBend, TurnsTheNormalAwayFromTheTrunkByItsShare) {
  const float unbent = facing_deg(0);
  ASSERT_GT(std::fabs(unbent), 20);
  for (const float share : {0.25f, 0.5f, 1.f})
    EXPECT_NEAR(facing_deg(share), (1 - share) * unbent, 0.1) << share;
}

}  // namespace
}  // namespace espalier
