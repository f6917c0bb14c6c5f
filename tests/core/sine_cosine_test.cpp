// Our sine and cosine are those of the C library, within a few roundings.
#include <gtest/gtest.h>

#include <numbers>

#include <espalier/core/sine_cosine.h>

namespace espalier {
namespace {

TEST(SineCosine, AreThoseOfTheLibrary) {
  for (float angle_deg = -1000; angle_deg < 1000; angle_deg += 0.37f) {
    const double radians = static_cast<double>(angle_deg) * std::numbers::pi / 180;
    const auto [sine, cosine] = sine_cosine_deg(angle_deg);
    EXPECT_NEAR(sine, std::sin(radians), 3e-7) << angle_deg;
    EXPECT_NEAR(cosine, std::cos(radians), 3e-7) << angle_deg;
  }
}

TEST(SineCosine, AreExactAtQuarterTurns) {
  for (int quarter = -8; quarter <= 8; ++quarter) {
    const auto [sine, cosine] = sine_cosine_deg(90.0f * static_cast<float>(quarter));
    EXPECT_EQ(std::fabs(sine), quarter % 2 == 0 ? 0 : 1) << quarter;
    EXPECT_EQ(std::fabs(cosine), quarter % 2 == 0 ? 1 : 0) << quarter;
  }
}

}  // namespace
}  // namespace espalier
