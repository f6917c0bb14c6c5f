// Contexts of modules, against the plain recursion that says what they mean.
#include <gtest/gtest.h>

#include <random>

#include <espalier/lsystem/derivation/context.h>

namespace espalier::lsystem {
namespace {

using Symbols = std::vector<SymbolId>;

/// The right context as the notation defines it, by recursion over string and pattern.
struct RecursiveMatch {
  const Symbols& string;
  const std::vector<PatternModule>& pattern;
  SymbolId open, close, skipped;
  bool follow;
  std::vector<std::uint32_t> matched = std::vector<std::uint32_t>(pattern.size());

  std::size_t past_branch(std::size_t at) const {
    int depth = 0;
    do depth += string[at] == open ? 1 : string[at] == close ? -1 : 0;
    while (++at < string.size() && depth > 0);
    return at;
  }
  bool from(std::size_t at, std::size_t k) {
    if (k == pattern.size()) return true;
    if (pattern[k].symbol == open) return branch(at, k);
    if (pattern[k].symbol == close) return end(at, k);
    return module(at, k);
  }
  bool branch(std::size_t at, std::size_t k) {
    while (at < string.size() && (string[at] == open || string[at] == skipped)) {
      if (string[at] == open && from(at + 1, k + 1)) return true;
      at = string[at] == open ? past_branch(at) : at + 1;
    }
    return false;
  }
  bool end(std::size_t at, std::size_t k) {
    while (at < string.size() && string[at] != close) at = string[at] == open ? past_branch(at) : at + 1;
    return at < string.size() && from(at + 1, k + 1);
  }
  bool module(std::size_t start, std::size_t k) {
    std::size_t at = start;
    while (at < string.size() && (string[at] == open || string[at] == skipped))
      at = string[at] == open ? past_branch(at) : at + 1;
    if (at < string.size() && string[at] == pattern[k].symbol) {
      matched[k] = static_cast<std::uint32_t>(at);
      if (from(at + 1, k + 1)) return true;
    }
    for (std::size_t i = start; follow && i < at; i = string[i] == open ? past_branch(i) : i + 1)
      if (string[i] == open && module(i + 1, k)) return true;
    return false;
  }
};

class RandomContexts : public testing::TestWithParam<bool> {
 protected:
  RandomContexts() {
    for (const char* name : {"[", "]", "A", "B", "S"}) alphabet_.intern(name, 0);
  }

  /// Balanced, of `letters` letters from A on.
  Symbols balanced(int length, SymbolId letters) {
    Symbols symbols;
    int depth = 0;
    for (int i = 0; i < length; ++i) {
      const unsigned draw = random_() % 4;
      if (draw == 0)
        symbols.push_back(0), ++depth;
      else if (draw == 1 && depth > 0)
        symbols.push_back(1), --depth;
      else
        symbols.push_back(static_cast<SymbolId>(2 + random_() % letters));
    }
    symbols.insert(symbols.end(), static_cast<std::size_t>(depth), 1);
    return symbols;
  }

  SymbolTable alphabet_;
  std::mt19937 random_{7};
};

TEST_P(RandomContexts, MatchAsTheRecursionDoes) {
  const std::vector<std::uint8_t> skipped{0, 0, 0, 0, 1};
  int matches = 0;
  for (int round = 0; round < 4000; ++round) {
    const Symbols string = balanced(3 + static_cast<int>(random_() % 20), 3);
    std::vector<PatternModule> pattern;
    for (const SymbolId symbol : balanced(1 + static_cast<int>(random_() % 5), 2))
      pattern.push_back({symbol, {}});
    ModuleString modules;
    for (const SymbolId symbol : string) modules.symbols.push_back(symbol);
    StringIndex index;
    index.build(modules, alphabet_, 0, 1, skipped, GetParam());
    Work work("test");
    for (std::size_t i = 0; i < string.size(); ++i) {
      if (string[i] < 2) continue;
      RecursiveMatch expected{string, pattern, 0, 1, 4, GetParam()};
      std::vector<std::uint32_t> matched(pattern.size());
      const bool fits = index.match_right(i, pattern, matched.data(), work);
      ASSERT_EQ(fits, expected.from(i + 1, 0)) << "round " << round << ", module " << i;
      if (!fits) continue;
      ++matches;
      for (std::size_t k = 0; k < pattern.size(); ++k)
        if (pattern[k].symbol > 1) {
          ASSERT_EQ(matched[k], expected.matched[k]) << "round " << round;
        }
    }
  }
  EXPECT_GT(matches, 1000);
}

INSTANTIATE_TEST_SUITE_P(Branches, RandomContexts, testing::Bool());

TEST(Contexts, OfAnyDepthNeedNoDepthOfCalls) {
  constexpr std::size_t kDepth = 1'000'000;
  SymbolTable alphabet;
  for (const char* name : {"[", "]", "A"}) alphabet.intern(name, 0);
  ModuleString modules;
  modules.symbols.push_back(2);
  for (std::size_t i = 0; i < kDepth; ++i) modules.symbols.push_back(0);
  modules.symbols.push_back(2);
  for (std::size_t i = 0; i < kDepth; ++i) modules.symbols.push_back(1);
  StringIndex index;
  const std::vector<std::uint8_t> skipped{0, 0, 0};
  index.build(modules, alphabet, 0, 1, skipped, true);
  Work work("test");
  std::uint32_t matched[2];
  const std::vector<PatternModule> one{{2, {}}}, two{{2, {}}, {2, {}}};
  EXPECT_TRUE(index.match_right(0, one, matched, work));
  EXPECT_EQ(matched[0], kDepth + 1);
  EXPECT_FALSE(index.match_right(0, two, matched, work));
}

}  // namespace
}  // namespace espalier::lsystem
