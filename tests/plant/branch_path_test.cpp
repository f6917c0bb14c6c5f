// Paths of branches as text, and from the arrays of a plant.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <espalier/core/error.h>
#include <espalier/plant/branch_path.h>

namespace espalier {
namespace {

RC_GTEST_PROP(BranchPath, TextReadsBackToTheSamePath, ()) {
  BranchPath path;
  const int parts = *rc::gen::inRange(1, 6);
  for (int i = 0; i < parts; ++i) {
    const bool split = *rc::gen::arbitrary<bool>();
    const std::uint32_t child = *rc::gen::inRange<std::uint32_t>(0, kFirstSplit);
    const std::uint32_t at = *rc::gen::inRange<std::uint32_t>(0, 1001),
                        number = *rc::gen::inRange<std::uint32_t>(0, kStemsPerSplit);
    path.push_back(split ? kFirstSplit + kStemsPerSplit * at + number : child);
  }
  RC_ASSERT(parse_branch_path(to_string(path), "here") == path);
}

TEST(BranchPath, TextNamesChildrenAndSplits) {
  EXPECT_EQ(to_string({0, 12, 3}), "0/12/3");
  EXPECT_EQ(parse_branch_path("0/split4.1/7", "here"),
            (BranchPath{0, kFirstSplit + 4 * kStemsPerSplit + 1, 7}));
}

class BadPath : public testing::TestWithParam<const char*> {};

TEST_P(BadPath, IsRefusedWithThePlaceAndTheText) {
  try {
    parse_branch_path(GetParam(), "tree.toml:7");
    FAIL() << "accepted '" << GetParam() << "'";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with("tree.toml:7: got '")) << message;
    EXPECT_NE(message.find(GetParam()), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(All, BadPath,
                         testing::Values("", "/", "0/", "/0", "0//1", "-1", "a", "0/1.5", "0/split",
                                         "0/split4", "0/split4.16", "0/splitx.1", "1000000", "99999999999",
                                         "0 /1"));

TEST(BranchPath, FollowsTheOriginsOfAStem) {
  Plant plant;
  plant.stems.origin = {-1, 0, 1};
  plant.stems.child_index = {2, kFirstSplit + kStemsPerSplit * 3 + 1, 5};
  EXPECT_EQ(to_string(path_of(plant, 2)), "2/split3.1/5");
}

}  // namespace
}  // namespace espalier
