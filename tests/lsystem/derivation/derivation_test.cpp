// Laws of derivation, against the strings that the papers print.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <espalier/lsystem/files/bundled.h>
#include <espalier/lsystem/files/grammar_file.h>

#include "support/strings.h"

namespace espalier::lsystem {
namespace {

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

TEST(Derivation, ContextSensitiveProductionsComeFirst) {  // [Herbaceous §2.4]
  EXPECT_EQ(strings_of("axiom: ABAC\nproductions:\n A --> X\n A > B --> Y\n", 1).back(), "YBXC");
}

TEST(Derivation, RightContextsSkipBranchesUnlessTheyAreToBeFollowed) {
  const std::string rest = "axiom: A[B]C\nproductions:\n A > B --> X\n";
  EXPECT_EQ(strings_of(rest, 1).back(), "A[B]C");
  EXPECT_EQ(strings_of("branches: follow\n" + rest, 1).back(), "X[B]C");
  EXPECT_EQ(strings_of("axiom: A[B]C\nproductions:\n A > [B] --> X\n A > C : false --> Y\n", 1).back(),
            "X[B]C");
}

TEST(Derivation, ParametersOfContextsAreBound) {
  EXPECT_EQ(
      strings_of(
          "axiom: A(1)B(2)[C(3)]D(4)\nproductions:\n A(a) < B(b) > [C(c)]D(d) --> E(a+10*b+100*c+1000*d)\n",
          1)
          .back(),
      "A(1)E(4321)[C(3)]D(4)");
}

TEST(Derivation, IgnoredSymbolsDoNotSeparate) {
  EXPECT_EQ(strings_of("ignore: +\naxiom: A+B\nproductions:\n A < B --> X\n", 1).back(), "A+X");
  EXPECT_EQ(strings_of("axiom: A+B\nproductions:\n A < B --> X\n", 1).back(), "A+B");
  EXPECT_EQ(strings_of("consider: A B\naxiom: AQ+B\nproductions:\n A < B --> X\n", 1).back(), "AQ+X");
}

TEST(Derivation, SuccessorsOfStochasticProductionsHaveTheirProbabilities) {
  const std::string text =
      "axiom: S\nproductions:\n S --> lua\n   for i = 1, 10000 do produce('A') end\n"
      " A --> B : 0.3\n A --> C : 0.5\n";
  const std::string string = strings_of(text, 2).back();
  const auto count = [&](char c) { return static_cast<double>(std::count(string.begin(), string.end(), c)); };
  EXPECT_NEAR(count('B'), 3000, 4 * std::sqrt(10000 * 0.3 * 0.7));
  EXPECT_NEAR(count('C'), 5000, 4 * std::sqrt(10000 * 0.5 * 0.5));
  EXPECT_NEAR(count('A'), 2000, 4 * std::sqrt(10000 * 0.2 * 0.8));  // what is left stays
  EXPECT_EQ(strings_of(text, 2).back(), string);
  EXPECT_NE(strings_of(text, 2, 2).back(), string);
}

TEST(Derivation, BlocksDoNotShow) {  // a string of many blocks is rewritten as a short one is
  const std::string rules =
      "productions:\n S --> lua\n   for i = 1, 2000 do produce('I', i) end\n"
      " I(a) < I(b) > I(c) --> I(b + (c - a))\n";
  const auto strings = strings_of("axiom: S\n" + rules, 2);
  std::string expected = "I(1)";
  for (int i = 2; i < 2000; ++i) expected += "I(" + std::to_string(i + 2) + ")";
  EXPECT_EQ(strings[2], expected + "I(2000)");
}

TEST(Derivation, TablesTakeTurns) {  // [Herbaceous §4.3.3]
  EXPECT_EQ(strings_of("axiom: A\nproductions:\n B --> C\ntable early when step <= 2:\n A --> AB\n"
                       "table late when step > 2:\n A --> X\n",
                       4),
            (Strings{"A", "AB", "ABC", "XCC", "XCC"}));
}

TEST(Derivation, LuaHooksSeeStepsAndMayCarryState) {
  EXPECT_EQ(strings_of("lua:\n  grown = 0\n  function on_step(step) grown = grown + step end\naxiom: A(0)\n"
                       "productions:\n A(x) --> A(grown)\n",
                       3),
            (Strings{"A(0)", "A(1)", "A(3)", "A(6)"}));
}

TEST(Derivation, StartsWithFreshLuaVariables) {
  const Grammar grammar = parse_grammar(
      "lua:\n  made = {}\n  function next_one() made[#made + 1] = 1 return #made end\naxiom: "
      "A(0)\nproductions:\n"
      " A(x) --> A(next_one())\n",
      "test.lsys");
  Derivation derivation(grammar);
  for (int i = 0; i < 2; ++i) {
    derivation.start(1);
    derivation.run(3);
    EXPECT_EQ(derivation.text(), "A(3)");
  }
  EXPECT_THROW(strings_of("axiom: A\nproductions:\n A --> lua\n   kept = 1\n   produce('B')\n", 1),
               InputError);
}

TEST(Derivation, NamesOfLuaCodeComeBeforeTheBuiltInOnes) {
  EXPECT_EQ(strings_of("lua:\n  function min(a, b) return a*100 + b end\naxiom: A(1)\nproductions:\n A(x) "
                       "--> A(min(x, 2))\n",
                       1)
                .back(),
            "A(102)");
}

TEST(Derivation, BodiesThatProduceNothingLeaveTheModule) {
  EXPECT_EQ(strings_of("axiom: A(1)A(5)A(9)\nproductions:\n A(x) --> lua\n   if x < 3 then return end\n"
                       "   if x < 7 then produce('[B', x, ']') else produce() end\n",
                       1)
                .back(),
            "A(1)[B(5)]");
}

TEST(Derivation, SymbolsMayHaveSeveralLetters) {
  EXPECT_EQ(strings_of("symbols: Apex Node\naxiom: Apex(2)\nproductions:\n Apex(n) --> Node Apex(n+1)A\n", 1)
                .back(),
            "NodeApex(3)A");
}

TEST(Derivation, UndefinedQueriesAreStars) {
  const Grammar grammar = parse_grammar("axiom: A?P(x,y)\n", "test.lsys");
  ModuleString string;
  SymbolTable alphabet = grammar.alphabet;
  string.symbols.push_back(alphabet.intern("?P", 2));
  string.values.push_back(NAN);
  string.values.push_back(2);
  EXPECT_EQ(to_text(string, alphabet), "?P(*,2)");
}

TEST(Derivation, QueriesSeeThroughInterpretationRules) {
  EXPECT_EQ(
      strings_of("angle: 90\naxiom: I(3)?P(x,z)+I(2)?P(x,y,z)?H(x,y,z)\ninterpretation:\n I(l) --> F(l)\n",
                 0)[0],
      "I(3)?P(0,3)+I(2)?P(-2,0,3)?H(-1,0,0)");
}

TEST(Derivation, AModuleWithOneParameterTakesTenBytes) {
  const Grammar grammar = parse_grammar(
      "axiom: S\nproductions:\n S --> lua\n   for i = 1, 50000 do produce('I', i) end\n I(x) --> I(x+1)\n",
      "test.lsys");
  Derivation derivation(grammar);
  derivation.start(1);
  derivation.run(4);
  EXPECT_EQ(derivation.string().memory_bytes(), 50000 * 10u);
}

TEST(Derivation, EndsWhenItIsRunAndNotWhileItAdvances) {
  const Grammar grammar = parse_grammar(
      "axiom: A\nlua:\n  ended = 0\n  function on_end() ended = 1 end\nproductions:\n  A : ended == 0 --> "
      "FA\n",
      "test.lsys");
  Derivation derivation(grammar);
  derivation.start(1);
  derivation.advance(2);
  derivation.advance(3);
  EXPECT_EQ(derivation.text(), "FFFA");
  derivation.run(3);
  derivation.advance(5);
  EXPECT_EQ(derivation.text(), "FFFA");
}

}  // namespace
}  // namespace espalier::lsystem
