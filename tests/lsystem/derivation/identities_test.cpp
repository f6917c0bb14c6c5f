// Interpretation rules with random(): what does not change looks the same in all steps, and what does is
// drawn independently.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include <espalier/lsystem/files/bundled.h>

#include "support/strings.h"

namespace espalier::lsystem {
namespace {

/// The strings that are drawn of the axiom and of each step.
Strings drawn_strings(const std::string& text, int steps, Seed seed = 1) {
  const Grammar grammar = parse_grammar(text, "test.lsys");
  Derivation derivation(grammar);
  derivation.start(seed);
  Strings strings;
  for (int step = 0; step <= steps; ++step) {
    derivation.advance(step);
    strings.push_back(to_text(derivation.interpreted(), derivation.alphabet()));
  }
  return strings;
}

/// All numbers in brackets.
std::vector<double> numbers_of(const std::string& string) {
  std::vector<double> numbers;
  for (std::size_t at = string.find('('); at != std::string::npos; at = string.find('(', at + 1))
    numbers.push_back(std::stod(string.substr(at + 1)));
  return numbers;
}

constexpr const char* kDraw = "interpretation:\n  A --> +(60*random()-30)F\n";

TEST(Identities, ModulesThatStayAreDrawnAsBefore) {
  // New modules come before, between and after the A, which move in the string.
  const Strings strings = drawn_strings(std::string("axiom: BAABA\nproductions:\n  B --> BCC\n") + kDraw, 4);
  for (const std::string& string : strings) EXPECT_EQ(numbers_of(string), numbers_of(strings[0]));
  EXPECT_GT(strings[4].size(), strings[0].size());
}

TEST(Identities, OlderModulesAreDrawnAsBefore) {
  const Strings strings = drawn_strings(
      "axiom: A(0)BA(5)\nproductions:\n  A(i) --> A(i+1)\n  B --> A(0)B\n"
      "interpretation:\n  A(i) --> +(60*random()-30)F\n",
      3);
  const std::vector<double> first = numbers_of(strings[0]), last = numbers_of(strings[3]);
  ASSERT_EQ(first.size(), 2u);
  ASSERT_EQ(last.size(), 5u);
  EXPECT_EQ(last.front(), first.front());
  EXPECT_EQ(last.back(), first.back());
}

TEST(Identities, AModuleThatOnlyTakesAnotherNameKeepsItsDraws) {
  const Strings strings = drawn_strings(
      "axiom: JIII\nproductions:\n  J < I --> J\ninterpretation:\n  I --> +(9*random())F\n  J --> "
      "+(9*random())G\n",
      3);
  for (const std::string& string : strings) EXPECT_EQ(numbers_of(string), numbers_of(strings[0]));
}

TEST(Identities, BranchesThatAreCutTakeTheirDrawsWithThem) {
  const Strings strings =
      drawn_strings(std::string("axiom: A[AAX]A[A]A\nproductions:\n  X --> %\n  A --> A\n") + kDraw, 2);
  EXPECT_EQ(numbers_of(strings[0]), numbers_of(strings[2]));
  const Strings cut = drawn_strings(std::string("axiom: A[XAA]A[A]A\nproductions:\n  X --> %\n") + kDraw, 2);
  const std::vector<double> before = numbers_of(cut[0]), after = numbers_of(cut[1]);
  ASSERT_EQ(before.size(), 6u);
  EXPECT_EQ(after, (std::vector<double>{before[0], before[3], before[4], before[5]}));
  EXPECT_EQ(numbers_of(cut[2]), after);
}

TEST(Identities, TheChoiceOfARuleStays) {
  const Strings strings = drawn_strings(
      "axiom: BLLLLLLLL\nproductions:\n  B --> BC\n  L --> L\n"
      "interpretation:\n  L --> F(1) : 0.5\n  L --> F(2) : 0.5\n",
      3);
  for (const std::string& string : strings) EXPECT_EQ(numbers_of(string), numbers_of(strings[0]));
  EXPECT_GT(std::count(strings[0].begin(), strings[0].end(), '2'), 0);
  EXPECT_GT(std::count(strings[0].begin(), strings[0].end(), '1'), 0);
}

TEST(Identities, ModulesOfAllStepsAreDrawnIndependently) {
  const std::string text = std::string("axiom: S\nproductions:\n  S --> AAAAAAAAAAS\n") + kDraw;
  const std::vector<double> numbers = numbers_of(drawn_strings(text, 200).back());
  ASSERT_EQ(numbers.size(), 2000u);
  double mean = 0, square = 0, neighbours = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double u = numbers[i] / 60;
    mean += u / 2000;
    square += u * u / 2000;
    neighbours += i < 10 ? 0 : u * numbers[i - 10] / 60 / 2000;  // the same place in the step before
  }
  EXPECT_NEAR(mean, 0, 5 * std::sqrt(1.0 / 12 / 2000));
  EXPECT_NEAR(square, 1.0 / 12, 0.008);
  EXPECT_LT(std::fabs(12 * neighbours), 5 / std::sqrt(2000.0));
}

TEST(Identities, SeedsAndCallsDrawTheirOwn) {
  const std::string text = std::string("axiom: AAAA\n") + kDraw;
  EXPECT_NE(drawn_strings(text, 0, 1), drawn_strings(text, 0, 2));
  EXPECT_EQ(drawn_strings(text, 0, 1), drawn_strings(text, 0, 1));
  const std::vector<double> two =
      numbers_of(drawn_strings("axiom: A\ninterpretation:\n  A --> +(random())-(random())\n", 0)[0]);
  EXPECT_NE(two.at(0), two.at(1));
}

TEST(Identities, HoldInBodiesOfLuaAndInLuaExpressions) {
  for (const char* rule : {"lua\n    produce(\"+\", 9*random(), \"F\")\n", "+(9*math.random(1, 1000))F\n"}) {
    const Strings strings = drawn_strings(
        std::string("axiom: BAABA\nproductions:\n  B --> BCC\ninterpretation:\n  A --> ") + rule, 3);
    for (const std::string& string : strings) EXPECT_EQ(numbers_of(string), numbers_of(strings[0])) << rule;
  }
}

/// The string that a bundled L-system draws after so many steps.
std::string drawn_string(const std::string& name, int steps) {
  const Grammar grammar = load_grammar(name);
  Derivation derivation(grammar);
  derivation.start(1);
  derivation.advance(steps);
  return to_text(derivation.interpreted(), derivation.alphabet());
}

// The signal turns I to J and no segment turns: what is drawn differs in colour and width only.
TEST(Identities, OfABundledModelHoldStillWhileASignalPasses) {
  const auto angles = [](const std::string& string) {
    std::vector<double> found;
    for (std::size_t at = string.find("+("); at != std::string::npos; at = string.find("+(", at + 1))
      found.push_back(std::stod(string.substr(at + 2)));
    return found;
  };
  EXPECT_EQ(angles(drawn_string("herbaceous_c", 0)), angles(drawn_string("herbaceous_c", 2)));
  EXPECT_NE(drawn_string("herbaceous_c", 0), drawn_string("herbaceous_c", 2));
}

}  // namespace
}  // namespace espalier::lsystem
