// How much of a fit's time each stage gets: data, with its source where it is set.
#include <gtest/gtest.h>

#include <espalier/fitting/starts/fit_plan.h>

namespace espalier {
namespace {

TEST(StageShares, OfTheSearchAreLessWhereTheBranchesAreSeenAndTraced) {
  EXPECT_EQ(shares_of("leafless").search, 0.15);
  for (const char* kind : {"leafy", "palm", "any"}) EXPECT_EQ(shares_of(kind).search, 0.4) << kind;
}

TEST(StageShares, LeaveTheFinishTheLastTwoFifthsOfTheRefinement) {
  for (const char* kind : {"leafless", "leafy", "palm", "any"})
    EXPECT_EQ(shares_of(kind).before_finish, 0.6) << kind;
}

}  // namespace
}  // namespace espalier
