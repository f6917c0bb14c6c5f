// Paths of branches as text, and from the arrays of a plant.
#include <gtest/gtest.h>

#include <espalier/plant/branch_path.h>

namespace espalier {
namespace {

TEST(BranchPath, TextNamesChildrenAndSplits) {
  EXPECT_EQ(to_string({0, 12, 3}), "0/12/3");
  EXPECT_EQ(to_string({0, kFirstSplit + 4 * kStemsPerSplit + 1, 7}), "0/split4.1/7");
  EXPECT_EQ(parse_path_part("split4.1"), kFirstSplit + 4 * kStemsPerSplit + 1);
}

TEST(BranchPath, FollowsTheOriginsOfAStem) {
  Plant plant;
  plant.stems.origin = {-1, 0, 1};
  plant.stems.child_index = {2, kFirstSplit + kStemsPerSplit * 3 + 1, 5};
  EXPECT_EQ(to_string(path_of(plant, 2)), "2/split3.1/5");
}

}  // namespace
}  // namespace espalier
