// Bands of calibration: kept as often as they say by uniform ranks, left by others.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <espalier/core/random.h>
#include <espalier/experiments/statistics/calibration_bands.h>

namespace espalier {
namespace {

constexpr std::array<double, 3> kShares{0.5, 0.8, 0.9};
constexpr std::size_t kTrials = 400, kStudies = 2000;

std::vector<double> ranks_of_study(std::uint64_t study, double power) {
  std::vector<double> ranks(kTrials);
  for (std::size_t i = 0; i < kTrials; ++i)
    ranks[i] = std::pow(
        static_cast<double>(uniform_unit(child_key(root_key(5), study), 1, static_cast<std::uint32_t>(i))),
        power);
  return ranks;
}

bool keeps_to_all_three(const std::vector<double>& ranks, double deviations) {
  for (const double share : kShares) {
    double held = 0;
    for (const double rank : ranks) held += std::fabs(rank - 0.5) <= 0.5 * share ? 1 : 0;
    const double deviation = std::sqrt(share * (1 - share) / static_cast<double>(kTrials));
    if (std::fabs(held / static_cast<double>(kTrials) - share) > deviations * deviation) return false;
  }
  return true;
}

template <typename Verdict>
double share_of_studies(double power, const Verdict& verdict) {
  double kept = 0;
  for (std::size_t study = 0; study < kStudies; ++study)
    kept += verdict(ranks_of_study(study, power)) ? 1 : 0;
  return kept / static_cast<double>(kStudies);
}

TEST(CalibrationBands, ThreeIntervalsAtOnceStayWithinAsOftenAsTheBandSays) {
  for (const double chance : {0.95, 0.8}) {
    const double deviations = joint_band_deviations(kShares, kTrials, chance);
    const double kept = share_of_studies(
        1, [&](const std::vector<double>& ranks) { return keeps_to_all_three(ranks, deviations); });
    EXPECT_NEAR(kept, chance, 0.02) << deviations;
  }
}

TEST(CalibrationBands, OfOneIntervalIsNarrowerThanOfThree) {
  EXPECT_GT(joint_band_deviations(kShares, kTrials, 0.95), 2.1);
  EXPECT_LT(joint_band_deviations(kShares, kTrials, 0.95), 2.4);  // three independent ones: 2.39
}

TEST(CalibrationBands, RankCurvesOfUniformRanksStayWithinAndOthersLeave) {
  const RankBand band = rank_band(kTrials, 50, 0.95);
  const auto is_kept = [&](const std::vector<double>& ranks) { return is_within(band, ranks); };
  EXPECT_NEAR(share_of_studies(1, is_kept), 0.95, 0.02);
  EXPECT_LT(share_of_studies(1.3, is_kept), 0.1);
}

}  // namespace
}  // namespace espalier
