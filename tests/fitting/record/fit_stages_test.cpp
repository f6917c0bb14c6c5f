// The stages of a fit by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <espalier/core/error.h>
#include <espalier/fitting/record/fit_stages.h>

namespace espalier {
namespace {

TEST(FitStages, AllCombinationsReadBack) {
  for (int bits = 0; bits < 16; ++bits) {
    const FitStages stages{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0};
    EXPECT_EQ(parse_stages(to_string(stages)), stages) << to_string(stages);
  }
}

TEST(FitStages, AreNamedInAnyOrder) {
  EXPECT_EQ(parse_stages("finish,search"), (FitStages{true, false, false, true}));
}

TEST(FitStages, RefusesOtherNames) {
  for (const char* text : {"", ",", "serach", "search,,finish", "starts,search", "search;finish"}) {
    try {
      parse_stages(text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(),
                  testing::HasSubstr("expected names of: starts, search,tracing,branches,finish"))
          << text;
    }
  }
}

}  // namespace
}  // namespace espalier
