// How much of a fit's time each stage gets: data, with its source where it is set.
#include <gtest/gtest.h>

#include <espalier/fitting/starts/fit_plan.h>

namespace espalier {
namespace {

TEST(StageShares, OfTheSearchAreLessWhereTheBranchesAreSeenAndTraced) {
  EXPECT_EQ(shares_of(KindChoice::leafless).search, 0.15);
  for (const KindChoice kind : {KindChoice::leafy, KindChoice::palm, KindChoice::any})
    EXPECT_EQ(shares_of(kind).search, 0.4) << name_of(kind);
}

TEST(StageShares, LeaveTheFinishTheLastTwoFifthsOfTheRefinement) {
  for (const KindChoice kind : {KindChoice::leafless, KindChoice::leafy, KindChoice::palm, KindChoice::any})
    EXPECT_EQ(shares_of(kind).before_finish, 0.6) << name_of(kind);
}

}  // namespace
}  // namespace espalier
