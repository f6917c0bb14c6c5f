// The bundled L-systems against what the papers say of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/bundled.h>

#include "support/strings.h"

namespace espalier::lsystem {
namespace {

std::size_t count(const std::string& string, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = string.find(part); at != std::string::npos; at = string.find(part, at + 1)) ++found;
  return found;
}

/// The contents of the branches that `opening` starts, in the order of the string.
Strings branches(const std::string& string, const std::string& opening) {
  Strings found;
  for (std::size_t at = string.find(opening); at != std::string::npos;) {
    int depth = 0;
    std::size_t end = at;
    do depth += string[end] == '[' ? 1 : string[end] == ']' ? -1 : 0;
    while (depth > 0 && ++end < string.size());
    found.push_back(string.substr(at, end - at));
    at = string.find(opening, end);
  }
  return found;
}

// [Topiary, §3], the text on L-system 4: "In derivation step 6 the apex of the main axis grows out of the
// clipping box. In step 7 this apex and the last internode are removed from the structure, and the
// bud-activating signal S is generated. […] a lateral branch is created in step 8. As it also extends beyond
// the bounding box, it is removed in step 9 […]. Signal S is generated again, and in step 10 it reaches a
// dormant bud."
TEST(PaperModels, PruningSignalsWakeTheBudBelow) {
  const Strings strings = strings_of(load_grammar("topiary_4"), 12);
  const auto segments = [&](std::size_t step) { return count(strings[step], "F"); };
  for (std::size_t step = 0; step < 6; ++step)
    EXPECT_EQ(count(strings[step], fmt::format("?P(0,{})", step + 1)), 1u);
  EXPECT_EQ(count(strings[6], "A?P(0,7)"), 1u);  // the box ends at 6
  EXPECT_EQ(count(strings[7], "A"), 0u);
  EXPECT_EQ(segments(7), segments(6) - 1);
  EXPECT_EQ(count(strings[7], "@oS"), 1u);
  EXPECT_EQ(count(strings[8], "[+FA?P("), 1u);
  EXPECT_EQ(count(strings[8], "@o"), count(strings[7], "@o") - 1);
  EXPECT_EQ(count(strings[9], "A"), 0u);
  EXPECT_EQ(count(strings[9], "[+S]"), 1u);
  EXPECT_EQ(count(strings[10], "@oSF"), 1u);
  EXPECT_EQ(count(strings[11], "[+FA"), 1u);
}

// The listing as it is printed has the signal T between: from the apex that is out to S it takes two steps
// where the text has one, so no size of the box gives the text's steps.
TEST(PaperModels, ThePrintedListingIsLateByAStepAtEachCut) {
  for (int box = 3; box < 9; ++box) {
    const Strings strings = strings_of(
        fmt::format(
            "angle: 60\nlet prune(x, y) = x < -{0}/2 or x > {0}/2 or y < 0 or y > {0}\nignore: + - /\n"
            "branches: follow\naxiom: FA?P(x,y)\nproductions:\n"
            "  A > ?P(x,y) : not prune(x, y) --> @oF/(180)A\n  A > ?P(x,y) : prune(x, y) --> T%\n"
            "  F > T --> S\n  F > S --> SF\n  S --> *\n  @o > S --> [+FA?P(x,y)]\n  T --> *\n",
            box),
        14);
    const auto first = [&](const std::string& part) {
      std::size_t step = 0;
      while (count(strings[step], part) == 0) ++step;
      return static_cast<int>(step);
    };
    EXPECT_EQ(first(fmt::format("A?P(0,{})", box + 1)), box);
    EXPECT_EQ(first("S"), box + 2);
    EXPECT_EQ(first("[+F"), box + 3);
    EXPECT_EQ(first("@oSF"), box + 6);
  }
}

// [Topiary, Eq. 1]: N(k+1) = N(k)·(1 + (2k+1)/k²), at most twice: 1, 2, 4, then 4k²/9.
TEST(PaperModels, BifurcationSlowsDownAsItsEquationSays) {
  const Grammar grammar = load_grammar("topiary_5");
  Derivation derivation(grammar);
  constexpr int kSeeds = 200, kSteps = 14;
  double sum = 0, squares = 0;
  for (Seed seed = 1; seed <= kSeeds; ++seed) {
    derivation.start(seed);
    derivation.run(kSteps);
    const auto apices = static_cast<double>(count(derivation.text(), "A("));
    sum += apices;
    squares += apices * apices;
  }
  const double mean = sum / kSeeds, error = std::sqrt((squares / kSeeds - mean * mean) / kSeeds);
  const double expected = 4.0 * (kSteps + 1) * (kSteps + 1) / 9;
  EXPECT_NEAR(mean, expected, 4 * error);
  EXPECT_LT(error, 0.03 * expected);
}

// The segments of L-system 5 are those that its equation adds: 1 + 2 + 4 + … + 4k²/9, in the mean.
TEST(PaperModels, SegmentsAreTheSumOfTheEquation) {
  const Grammar grammar = load_grammar("topiary_5");
  Derivation derivation(grammar);
  constexpr int kSeeds = 200, kSteps = 12;
  double expected = 0, shoots = 1;
  for (int k = 1; k <= kSteps + 1; ++k) {
    expected += shoots;
    shoots *= 1 + std::min(1.0, (2.0 * k + 1) / (k * k));
  }
  double sum = 0, squares = 0;
  for (Seed seed = 1; seed <= kSeeds; ++seed) {
    derivation.start(seed);
    derivation.run(kSteps);
    const auto segments = static_cast<double>(count(derivation.text(), "F"));
    sum += segments;
    squares += segments * segments;
  }
  const double mean = sum / kSeeds, error = std::sqrt((squares / kSeeds - mean * mean) / kSeeds);
  EXPECT_NEAR(mean, expected, 4 * error);
  EXPECT_LT(error, 0.03 * expected);
}

// [Topiary §5, Fig. 7]: the younger the apices of woken buds, the more they branch: an age of one is the most
// vigorous.
TEST(PaperModels, YoungerReiterationsAreMoreVigorous) {
  const auto segments = [](const char* name) {
    const Grammar grammar = load_grammar(name);
    Derivation derivation(grammar);
    std::size_t sum = 0;
    for (Seed seed = 1; seed <= 3; ++seed) {
      derivation.start(seed);
      derivation.run(31);
      sum += count(derivation.text(), "F");
    }
    return sum;
  };
  const std::size_t old = segments("topiary_7_old"), birth = segments("topiary_7_birth"),
                    young = segments("topiary_7_young");
  EXPECT_GT(birth, old);
  EXPECT_GT(young, birth);
}

// [Herbaceous §2.4, §3]: the topologies of (a), (b), (c) and (d), and the strings of (a') and (c').
TEST(PaperModels, FourPatternsHaveTheirStrings) {
  const auto last = [](const char* name, int steps) { return strings_of(load_grammar(name), steps).back(); };
  EXPECT_EQ(last("herbaceous_a", 1), "S[S]S[S]S");
  EXPECT_EQ(last("herbaceous_a_prime", 1), "S['-S]S['+S]S");
  EXPECT_EQ(count(last("herbaceous_a", 4), "S"), 625u);
  EXPECT_EQ(last("herbaceous_b", 2), "SS[-S[-A]S[+A]A]SS[+S[-A]S[+A]A]S[-A]S[+A]A");
  EXPECT_EQ(strings_of(load_grammar("herbaceous_c"), 3),
            (Strings{"J[I]I[I]I[I]I", "J[J]J[I]I[I]I", "J[J]J[J]J[I]I", "J[J]J[J]J[J]J"}));
  EXPECT_EQ(last("herbaceous_c_prime", 2), "J[+J]J[-J]J[+I]I");
  EXPECT_EQ(strings_of(load_grammar("herbaceous_d"), 2).back(), "I[+I]J[-I]J[+I]J");
}

TEST(PaperModels, TopiaryStaysNearItsBox) {
  const Grammar grammar = load_grammar("topiary_6");
  Derivation derivation(grammar);
  derivation.start(3);
  derivation.run(27);
  Plant plant;
  build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant);
  const double reach_m = 0.1 * (12.0 / 2 + 2.5);  // an apex is cut one step after it left, leaves stick out
  for (const Vec3& point : plant.knots.point_m) {
    EXPECT_LT(std::fabs(point.x), reach_m);
    EXPECT_LT(point.z, 0.1 * 14.5);
  }
  EXPECT_GT(plant.stems.size(), 100u);
}

/// When each lateral branch flowered, and how many internodes it had then.
struct Flowering {
  int step = 0;
  std::size_t internodes = 0;
};

std::map<std::size_t, Flowering> flowerings(const Grammar& grammar, int steps) {
  std::map<std::size_t, Flowering> by_branch;
  const Strings strings = strings_of(grammar, steps);
  for (int step = 0; step <= steps; ++step) {
    const Strings lateral = branches(strings[static_cast<std::size_t>(step)], "[&(45)");
    for (std::size_t k = 0; k < lateral.size(); ++k)
      if (count(lateral[k], "K(") > 0 && !by_branch.contains(k))
        by_branch[k] = {step, count(lateral[k], "J")};
  }
  return by_branch;
}

// [Herbaceous §4.4.1]: t = k(un − vm)/(n − v) + dn/(n − v), l = −(k/n)(m − u)·n/(n − v) + d/(n − v), which
// ignores that both are whole numbers.
void expect_flowering(const Grammar& grammar, double d, double m, double n, double u, double v) {
  const auto by_branch = flowerings(grammar, 60);
  ASSERT_GE(by_branch.size(), 3u);
  for (const auto& [branch, flowering] : by_branch) {
    const double k = static_cast<double>(branch) + 1;
    const double time = k * (u * n - v * m) / (n - v) + d * n / (n - v);
    const double length = -k * (m - u) / (n - v) + d / (n - v);
    EXPECT_NEAR(flowering.step, time, 2 * n + 1) << "branch " << k;
    EXPECT_NEAR(static_cast<double>(flowering.internodes), length, 2) << "branch " << k;
  }
}

// The same in whole numbers, exactly: S starts in step d + 1 and passes k internodes of the main axis and l
// of a lateral one in ku + lv steps; the next internode of branch k comes in step km + (l + 1)n, so l is the
// first one where the signal is earlier, and the flower is there one step later.
TEST(PaperModels, FlowersComeInTheStepOfWholeNumbers) {
  const Grammar grammar = load_grammar("inflorescence_acropetal");
  for (const auto& [d, m, n, u, v] : {std::array{12, 2, 3, 1, 1},
                                      {12, 3, 3, 1, 2},
                                      {17, 3, 5, 2, 1},
                                      {9, 2, 4, 1, 3},
                                      {20, 4, 3, 2, 2},
                                      {15, 2, 2, 1, 1}}) {
    Derivation derivation(grammar);
    const std::array<double, 5> values{static_cast<double>(d), static_cast<double>(m), static_cast<double>(n),
                                       static_cast<double>(u), static_cast<double>(v)};
    derivation.start(values, 1);
    std::map<std::size_t, Flowering> by_branch;
    for (int step = 1; step <= 90; ++step) {
      derivation.step();
      const Strings lateral = branches(derivation.text(), "[&(45)");
      for (std::size_t b = 0; b < lateral.size(); ++b)
        if (count(lateral[b], "K(") > 0) by_branch.try_emplace(b, Flowering{step, count(lateral[b], "J")});
    }
    ASSERT_GE(by_branch.size(), 2u);
    for (const auto& [branch, flowering] : by_branch) {
      const int k = static_cast<int>(branch) + 1;
      int l = 0;
      while (k * m + (l + 1) * n <= d + 1 + k * u + l * v) ++l;
      EXPECT_EQ(flowering.internodes, static_cast<std::size_t>(l)) << "branch " << k;
      EXPECT_EQ(flowering.step, d + 2 + k * u + l * v) << "branch " << k;
    }
  }
}

TEST(PaperModels, FlowersOpenUpwardsWhereDeltaIsPositive) {
  const Grammar grammar = load_grammar("inflorescence_acropetal");
  expect_flowering(grammar, 12, 2, 3, 1, 1);
  int last = 0;
  for (const auto& [branch, flowering] : flowerings(grammar, 60)) {
    EXPECT_GE(flowering.step, last) << branch;
    last = flowering.step;
  }
}

TEST(PaperModels, FlowersOpenDownwardsWhereDeltaIsNegative) {
  const Grammar grammar = load_grammar("inflorescence_basipetal");
  expect_flowering(grammar, 12, 3, 3, 1, 2);
  int last = 1000;
  for (const auto& [branch, flowering] : flowerings(grammar, 60)) {
    EXPECT_LE(flowering.step, last) << branch;
    last = flowering.step;
  }
}

// [Herbaceous §6]: the left half of the leaf. Its print lost brackets; without them it is our third string,
// with the axiom counted as the first.
TEST(PaperModels, CordateLeafHasThePrintedString) {
  const std::string text =
      "axiom: [A][B]\nproductions:\n p1: A --> [+A?]C#\n p2: B --> [-B?]C#\n p3: C --> IC\n";
  const std::string left = strings_of(text, 3).back();
  EXPECT_EQ(left.substr(0, left.size() / 2), "[[+[+[+A?]C#?]IC#?]IIC#]");
  const auto without_brackets = [](std::string string) {
    std::erase_if(string, [](char c) { return c == '[' || c == ']'; });
    return string;
  };
  EXPECT_EQ(without_brackets(left.substr(0, left.size() / 2)), without_brackets("[+[[+[[+A?]C#?]IC#?]IIC#]"));
}

// [Blender thesis, listing 5.1]: the flowering sequence is basipetal.
TEST(PaperModels, WallLettuceFlowersFromTheTopDownwards) {
  const Grammar grammar = load_grammar("mycelis");
  const Strings strings = strings_of(grammar, 100);
  std::map<std::size_t, int> first_flower;
  int main_axis = 0;
  for (int step = 0; step <= 100; ++step) {
    const std::string& string = strings[static_cast<std::size_t>(step)];
    if (main_axis == 0 && count(string, "O(") > 0) main_axis = step;
    const Strings lateral = branches(string, "[+(30)");
    for (std::size_t k = 0; k < lateral.size(); ++k)
      if (count(lateral[k], "O(") > 0) first_flower.try_emplace(k, step);
  }
  ASSERT_GE(first_flower.size(), 4u);
  int above = 1000;
  for (const auto& [branch, step] : first_flower) {
    EXPECT_LT(step, above) << "branch " << branch;
    EXPECT_GT(step, main_axis);
    above = step;
  }
}

// [Herbaceous §4.4.3]: the apex of each axis flowers first, then its lateral axes from the top downwards,
// which are the longer the lower they are; so on each axis of the next order.
TEST(PaperModels, ThreeSignalsMakeFlowersFromTheTopDownwards) {
  const Grammar grammar = load_grammar("wall_lettuce");
  const Strings strings = strings_of(grammar, 130);
  std::map<std::size_t, int> first_flower;
  std::map<std::size_t, std::size_t> own_internodes;
  int main_axis = 0;
  const auto without_branches = [](const std::string& branch) {
    std::string axis;
    int depth = 0;
    for (const char c : branch) {
      depth -= c == ']' ? 1 : 0;
      if (depth == 1) axis += c;
      depth += c == '[' ? 1 : 0;
    }
    return axis;
  };
  for (int step = 0; step <= 130; ++step) {
    const std::string& string = strings[static_cast<std::size_t>(step)];
    if (main_axis == 0 && count(string, "K(") > 0) main_axis = step;
    const Strings lateral = branches(string, "[&(38)");
    for (std::size_t k = 0; k < lateral.size(); ++k) {
      const std::string axis = without_branches(lateral[k]);
      if (count(axis, "K(") == 0 || !first_flower.try_emplace(k, step).second) continue;
      own_internodes[k] = count(axis, "I(");
    }
  }
  ASSERT_GE(first_flower.size(), 8u);
  int above = 1000;
  std::size_t longer = 1000;
  for (const auto& [branch, step] : first_flower) {  // from the lowest to the highest
    EXPECT_LT(step, above) << "branch " << branch;
    EXPECT_LE(own_internodes[branch], longer) << "branch " << branch;
    EXPECT_GT(step, main_axis);
    above = step;
    longer = own_internodes[branch];
  }
  EXPECT_GT(count(branches(strings.back(), "[&(38)").front(), "K("), 3u);  // flowers of the second order
}

TEST(PaperModels, EachOneGrowsAPlantThatRepeats) {
  for (const std::string& name : bundled_names()) {
    SCOPED_TRACE(name);
    const Grammar grammar = load_grammar(name);
    Plant plants[2];
    for (Plant& plant : plants) {
      Derivation derivation(grammar);
      derivation.start(5);
      derivation.run(derivation.settings().steps);
      build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant);
    }
    EXPECT_GT(plants[0].stems.size() + plants[0].leaves.size(), 0u);
    EXPECT_EQ(plants[0].knots.radius_m, plants[1].knots.radius_m);
    const Bounds box = bounds(plants[0]), again = bounds(plants[1]);
    EXPECT_TRUE(std::isfinite(box.upper.z) && box.upper.z > box.lower.z);
    EXPECT_TRUE(box.upper == again.upper && box.lower == again.lower);
  }
}

}  // namespace
}  // namespace espalier::lsystem
