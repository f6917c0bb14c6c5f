// Leaves that training keeps inside of a volume.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <espalier/environment/leaves_inside.h>

namespace espalier {
namespace {

void add_leaf(Leaves& leaves, Vec3 position_m, Vec3 axis, float length_m) {
  leaves.position_m.push_back(position_m);
  leaves.axis.push_back(axis);
  leaves.side.push_back({0, 1, 0});
  leaves.length_m.push_back(length_m);
  leaves.width_m.push_back(length_m / 2);
  leaves.kind.push_back(LeafKind::leaf);
}

TEST(LeavesInside, OneThatFitsStaysOneThatReachesOutShrinksOneOutsideGoes) {
  const auto ball = make_ball({0, 0, 0}, 1);
  Leaves leaves;
  add_leaf(leaves, {0, 0, 0}, {1, 0, 0}, 0.5f);
  add_leaf(leaves, {0.75f, 0, 0}, {1, 0, 0}, 0.4f);  // three quarters of it at 1.05 m
  add_leaf(leaves, {0.95f, 0, 0}, {1, 0, 0}, 0.4f);
  add_leaf(leaves, {3, 0, 0}, {1, 0, 0}, 0.4f);
  keep_leaves_inside(*ball, leaves);
  ASSERT_EQ(leaves.size(), 2u);
  EXPECT_EQ(leaves.length_m[0], 0.5f);
  EXPECT_FLOAT_EQ(leaves.length_m[1], 0.3f);
  EXPECT_FLOAT_EQ(leaves.width_m[1], 0.15f);
}

RC_GTEST_PROP(LeavesInside, ThreeQuartersOfEachAreInsideAndASecondTimeChangesNothing, ()) {
  const auto box = make_box({0, 0, 1}, {2, 2, 2});
  const auto number = [](int from, int to) { return static_cast<float>(*rc::gen::inRange(from, to)) / 100; };
  Leaves leaves;
  for (int i = 0; i < 50; ++i) {
    const Vec3 position{number(-150, 150), number(-150, 150), number(-50, 250)};
    add_leaf(leaves, position, i % 2 ? Vec3{1, 0, 0} : Vec3{0, 0, 1}, number(5, 60));
  }
  keep_leaves_inside(*box, leaves);
  for (std::size_t i = 0; i < leaves.size(); ++i)
    RC_ASSERT(box->contains(leaves.position_m[i] + leaves.axis[i] * (0.749f * leaves.length_m[i])));
  const std::vector<float> lengths = leaves.length_m;
  keep_leaves_inside(*box, leaves);
  RC_ASSERT(leaves.length_m == lengths);
}

}  // namespace
}  // namespace espalier
