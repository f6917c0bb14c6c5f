// The archive of a search: good, different, and the same whoever counts.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include <espalier/fitting/optimizers/random_stream.h>
#include <espalier/fitting/search/solution_archive.h>

namespace espalier {
namespace {

constexpr std::size_t kDimension = 4;

SearchSpace box() {
  SearchSpace space{ParameterValues(kDimension), {}};
  for (std::size_t i = 0; i < kDimension; ++i) space.free.push_back({.row = i, .name = "x"});
  return space;
}

/// A bowl around the middle of the box that is flat along its last coordinate.
double bowl(const ParameterValues& x) {
  double sum = 0.1;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) sum += (x[i] - 0.5) * (x[i] - 0.5);
  return sum;
}

ParameterValues drawn(RandomStream& draws) {
  ParameterValues x(kDimension);
  for (double& coordinate : x) coordinate = draws.uniform();
  return x;
}

RC_GTEST_PROP(SolutionArchive, HoldsTheBestAndNothingMuchWorseNorAlike, ()) {
  RandomStream draws(root_key(*rc::gen::inRange<Seed>(0, 1000)));
  SolutionArchive archive(box());
  double best = 1e9;
  for (int i = 0; i < 3000; ++i) {
    const ParameterValues x = drawn(draws);
    best = std::min(best, bowl(x));
    archive.offer(x, bowl(x));
    const auto& kept = archive.solutions();
    RC_ASSERT(kept.front().score == best);
    RC_ASSERT(kept.size() <= 8u);
    RC_ASSERT(kept.back().score <= best + archive.tolerance());
    for (std::size_t a = 0; a < kept.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) RC_ASSERT(distance_between(kept[a], kept[b]) >= 0.05);
  }
}

TEST(SolutionArchive, SpreadsWhereTheScoreIsFlat) {
  RandomStream draws(root_key(1));
  SolutionArchive archive(box());
  for (int i = 0; i < 20000; ++i) {
    const ParameterValues x = drawn(draws);
    archive.offer(x, bowl(x));
  }
  const auto spread = [&](std::size_t row) {
    const auto [least, most] =
        std::minmax_element(archive.solutions().begin(), archive.solutions().end(),
                            [&](const auto& a, const auto& b) { return a.unit[row] < b.unit[row]; });
    return most->unit[row] - least->unit[row];
  };
  EXPECT_GT(archive.solutions().size(), 3u);
  EXPECT_GT(spread(kDimension - 1), 0.7);
  for (std::size_t row = 0; row + 1 < kDimension; ++row) EXPECT_LT(spread(row), 0.3) << row;
}

TEST(SolutionArchive, OfTwoAlikeItKeepsTheBetter) {
  SolutionArchive archive(box());
  archive.offer({0.5, 0.5, 0.5, 0.5}, 0.1000);
  archive.offer({0.5, 0.5, 0.5, 0.9}, 0.1010);
  archive.offer({0.5, 0.5, 0.5, 0.91}, 0.1005);
  ASSERT_EQ(archive.solutions().size(), 2u);
  EXPECT_EQ(archive.solutions()[1].values[3], 0.91);
}

TEST(SolutionArchive, ABetterOneSendsAwayWhatIsNoLongerGood) {
  SolutionArchive archive(box());
  archive.offer({0.1, 0.1, 0.1, 0.1}, 0.5);
  archive.offer({0.9, 0.9, 0.9, 0.9}, 0.52);
  EXPECT_EQ(archive.solutions().size(), 2u);
  archive.offer({0.1, 0.9, 0.1, 0.9}, 0.4);
  EXPECT_EQ(archive.solutions().size(), 1u);
}

}  // namespace
}  // namespace espalier
