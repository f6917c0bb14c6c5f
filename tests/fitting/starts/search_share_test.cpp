// How much of a fit's time the search gets where refinement follows.
#include <gtest/gtest.h>

#include <espalier/fitting/starts/picture_choice.h>

namespace espalier {
namespace {

TEST(SearchShare, IsLessWhereTheBranchesAreSeenAndTraced) {
  EXPECT_EQ(search_share("leafless"), 0.15);
  for (const char* kind : {"leafy", "palm", "any"}) EXPECT_EQ(search_share(kind), 0.4) << kind;
}

}  // namespace
}  // namespace espalier
