// Laws of derivation, against the strings that the papers print.
#include "lsystem/derivation.h"

#include <gtest/gtest.h>

namespace espalier::lsystem {
namespace {

/// The strings of the axiom and of `steps` derivation steps.
std::vector<std::string> strings_of(const std::string& text, int steps, Seed seed = 1) {
  const Grammar grammar = parse_grammar(text, "test.lsys");
  Derivation derivation(grammar);
  derivation.start(seed);
  std::vector<std::string> strings{derivation.text()};
  for (int i = 0; i < steps; ++i) {
    derivation.step();
    strings.push_back(derivation.text());
  }
  return strings;
}

using Strings = std::vector<std::string>;

TEST(Derivation, GivesTheStringsOfRacemes) {  // [Herbaceous §4.1], an index is a parameter
  const auto strings = strings_of(R"(
axiom: A
productions:
  p1: A --> I(0)[I(0)F(0)]A
  p2: I(i) --> I(i+1)
  p3: F(i) --> F(i+1)
)",
                                  4);
  EXPECT_EQ(strings, (Strings{"A", "I(0)[I(0)F(0)]A", "I(1)[I(1)F(1)]I(0)[I(0)F(0)]A",
                              "I(2)[I(2)F(2)]I(1)[I(1)F(1)]I(0)[I(0)F(0)]A",
                              "I(3)[I(3)F(3)]I(2)[I(2)F(2)]I(1)[I(1)F(1)]I(0)[I(0)F(0)]A"}));
}

TEST(Derivation, GivesStringsAndPositionsOfQueryModules) {  // [Topiary, L-system 2]
  const auto strings = strings_of(R"(
angle: 90
axiom: A
productions:
  p1: A --> F(1)?P(x,y)-A
  p2: F(k) --> F(k+1)
)",
                                  3);
  EXPECT_EQ(strings, (Strings{"A", "F(1)?P(0,1)-A", "F(2)?P(0,2)-F(1)?P(1,2)-A",
                              "F(3)?P(0,3)-F(2)?P(2,3)-F(1)?P(2,2)-A"}));
}

// [Herbaceous §2.3]: BC < S > G[HI]M. Its string (*) lost a bracket in print: as there, L would lie between
// G and M; [ABOP p. 32] has the string with L in the branch.
TEST(Derivation, MatchesContextsAcrossBranches) {
  const std::string production = "\nproductions:\n BC < S > G[HI]M --> X\n";
  EXPECT_EQ(strings_of("axiom: ABC[DE][SG[HI[JK]L]MNO]" + production, 1)[1], "ABC[DE][XG[HI[JK]L]MNO]");
  EXPECT_EQ(strings_of("axiom: ABC[DE][SG[HI][JK]LMNO]" + production, 1)[1], "ABC[DE][SG[HI][JK]LMNO]");
  EXPECT_EQ(strings_of("axiom: ABC[DE][SG[JK][HI]MNO]" + production, 1)[1], "ABC[DE][XG[JK][HI]MNO]");
  EXPECT_EQ(strings_of("axiom: ABD[DE][SG[HI]MNO]" + production, 1)[1], "ABD[DE][SG[HI]MNO]");
}

TEST(Derivation, SignalsTravelUpAndDown) {  // [Herbaceous §2.4, L-systems (c) and (d), §3 (c')]
  EXPECT_EQ(strings_of("ignore: + -\naxiom: J[+I]I[-I]I[+I]I\nproductions:\n p: J < I --> J\n", 3),
            (Strings{"J[+I]I[-I]I[+I]I", "J[+J]J[-I]I[+I]I", "J[+J]J[-J]J[+I]I", "J[+J]J[-J]J[+J]J"}));
  EXPECT_EQ(strings_of("axiom: I[I]I[I]I[I]J\nproductions:\n p: I > J --> J\n", 2),
            (Strings{"I[I]I[I]I[I]J", "I[I]I[I]J[I]J", "I[I]J[I]J[I]J"}));
}

TEST(Derivation, CutsTheRestOfABranch) {
  EXPECT_EQ(strings_of("axiom: A[BC[D]E]F\nproductions:\n C --> X%\n", 1).back(), "A[BX]F");
  EXPECT_EQ(strings_of("axiom: A[BC]F\nproductions:\n A --> A%\n", 1).back(), "A");
}

}  // namespace
}  // namespace espalier::lsystem
