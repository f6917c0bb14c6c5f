// Draws: uniform, independent of their neighbours in index, purpose and place, and what they were.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <espalier/core/random.h>

namespace espalier {
namespace {

constexpr int kDraws = 100'000;

/// Mean product of two draws in [-1, 1): 0 for independent ones, with a standard deviation of 1/(3√n).
template <typename Pair>
double correlation(Pair pair) {
  double sum = 0;
  for (int i = 0; i < kDraws; ++i) sum += pair(i);
  return 3 * sum / kDraws;
}

TEST(Random, FillsTheUnitIntervalEvenly) {
  std::array<int, 20> bins{};
  for (int i = 0; i < kDraws; ++i)
    ++bins[static_cast<std::size_t>(20 * uniform_unit(root_key(7), 3, static_cast<std::uint32_t>(i)))];
  double chi_squared = 0;
  for (const int count : bins) chi_squared += std::pow(count - kDraws / 20.0, 2) / (kDraws / 20.0);
  EXPECT_LT(chi_squared, 50);  // 19 degrees of freedom: 1 in 7,000
}

TEST(Random, NeighboursAreIndependent) {
  const auto draw = [](std::uint64_t place, std::uint32_t purpose, int index) {
    return uniform_signed(child_key(root_key(1), place), purpose, static_cast<std::uint32_t>(index));
  };
  const double four_deviations = 4 / std::sqrt(kDraws);
  EXPECT_LT(std::fabs(correlation([&](int i) { return draw(0, 1, i) * draw(0, 1, i + 1); })),
            four_deviations);
  EXPECT_LT(std::fabs(correlation([&](int i) { return draw(0, 1, i) * draw(0, 2, i); })), four_deviations);
  EXPECT_LT(std::fabs(correlation([&](int i) {
              const auto place = static_cast<std::uint64_t>(i);
              return draw(place, 1, 0) * draw(place + 1, 1, 0);
            })),
            four_deviations);
}

TEST(Random, ADrawBelongsToItsPlace) {
  const RandomKey key = child_key(root_key(5), 9);
  EXPECT_EQ(random_bits(key, 2, 4), random_bits(child_key(root_key(5), 9), 2, 4));
  EXPECT_NE(random_bits(key, 2, 4), random_bits(child_key(root_key(5), 8), 2, 4));
  EXPECT_NE(random_bits(key, 2, 4), random_bits(child_key(root_key(6), 9), 2, 4));
}

}  // namespace
}  // namespace espalier
