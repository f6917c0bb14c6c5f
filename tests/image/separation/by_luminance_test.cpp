#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/image/separation/by_luminance.h>

namespace espalier {
namespace {

/// Otsu's criterion: the variance within the classes, weighted by their sizes.
double variance_within(const std::vector<std::size_t>& histogram, int threshold) {
  double count[2] = {0, 0}, sum[2] = {0, 0}, squares[2] = {0, 0};
  for (std::size_t bin = 0; bin < histogram.size(); ++bin) {
    const int side = static_cast<int>(bin) > threshold;
    const auto weight = static_cast<double>(histogram[bin]), value = static_cast<double>(bin);
    count[side] += weight, sum[side] += weight * value, squares[side] += weight * value * value;
  }
  double within = 0;
  for (int side = 0; side < 2; ++side)
    if (count[side] > 0) within += squares[side] - sum[side] * sum[side] / count[side];
  return within;
}

RC_GTEST_PROP(Otsu, NoThresholdLeavesLessVarianceWithinTheClasses, ()) {
  const auto histogram =
      *rc::gen::container<std::vector<std::size_t>>(32, rc::gen::inRange<std::size_t>(1, 1000));
  const double found = variance_within(histogram, otsu_threshold(histogram));
  for (int threshold = 0; threshold < 31; ++threshold)
    RC_ASSERT(found <= variance_within(histogram, threshold) * (1 + 1e-9));
}

TEST(Otsu, TwoTonesAreSplitInTheMiddle) {
  std::vector<std::size_t> histogram(256, 0);
  histogram[0] = 1000;
  histogram[255] = 10;
  EXPECT_NEAR(otsu_threshold(histogram), 127, 1);
}

}  // namespace
}  // namespace espalier
