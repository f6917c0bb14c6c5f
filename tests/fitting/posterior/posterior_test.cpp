// Posteriors of a model whose posterior is known: unknowns are normal, summaries are unknowns with noise,
// their squares, and numbers that say nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <espalier/core/error.h>
#include <espalier/fitting/posterior/interval_chart.h>
#include <espalier/fitting/posterior/posterior_summary.h>

#include "support/small_training.h"

namespace espalier {
namespace {

constexpr double kNoise = 0.5;
constexpr Eigen::Index kUnknowns = 3, kSummaries = 8;

struct Toy {
  Eigen::MatrixXd unknowns, summaries;
};

/// The third unknown shows in nothing.
Toy draw_toy(Eigen::Index draws, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Toy toy{Eigen::MatrixXd(draws, kUnknowns), Eigen::MatrixXd(draws, kSummaries)};
  for (Eigen::Index i = 0; i < draws; ++i) {
    for (Eigen::Index k = 0; k < kUnknowns; ++k) toy.unknowns(i, k) = normal(random);
    for (Eigen::Index k = 0; k < 2; ++k) toy.summaries(i, k) = toy.unknowns(i, k) + kNoise * normal(random);
    toy.summaries(i, 2) = toy.summaries(i, 0) * toy.summaries(i, 0);
    toy.summaries(i, 3) = std::exp(toy.summaries(i, 1));
    for (Eigen::Index k = 4; k < kSummaries; ++k) toy.summaries(i, k) = normal(random);
  }
  return toy;
}

const Toy& toy_table() {
  static const Toy table = draw_toy(8000, 1);
  return table;
}

const PosteriorEstimator& estimator() {
  static const PosteriorEstimator made(toy_table().unknowns, toy_table().summaries, small_training());
  return made;
}

std::vector<double> row_of(const Eigen::MatrixXd& matrix, Eigen::Index row) {
  return {matrix.row(row).begin(), matrix.row(row).end()};
}

constexpr Eigen::Index kTruths = 400;

const Toy& truths() {
  static const Toy drawn = draw_toy(kTruths, 2);
  return drawn;
}

const std::vector<Posterior>& posteriors_of_truths() {
  static const std::vector<Posterior> all = [] {
    std::vector<Posterior> made;
    for (Eigen::Index i = 0; i < kTruths; ++i)
      made.push_back(estimator().estimate(row_of(truths().summaries, i)));
    return made;
  }();
  return all;
}

/// The share of truths that lie in the central interval; `narrowed` multiplies its distance from the median.
double coverage(double share, double narrowed, Eigen::Index unknown) {
  int held = 0;
  for (Eigen::Index i = 0; i < kTruths; ++i) {
    const Posterior& posterior = posteriors_of_truths()[static_cast<std::size_t>(i)];
    const auto k = static_cast<std::size_t>(unknown);
    const double middle = posterior_quantile(posterior, k, 0.5);
    const auto end = [&](double at) {
      return middle + narrowed * (posterior_quantile(posterior, k, at) - middle);
    };
    const double truth = truths().unknowns(i, unknown);
    held += end(0.5 - share / 2) <= truth && truth <= end(0.5 + share / 2);
  }
  return static_cast<double>(held) / static_cast<double>(kTruths);
}

double band(double share) { return 2.6 * std::sqrt(share * (1 - share) / 400); }  // 99 % of counts

TEST(Posterior, IntervalsHoldTheTruthAsOftenAsTheySay) {
  for (const double share : kIntervals)
    for (Eigen::Index unknown = 0; unknown < kUnknowns; ++unknown)
      EXPECT_NEAR(coverage(share, 1, unknown), share, band(share)) << share << " of unknown " << unknown;
}

TEST(Posterior, OneTooNarrowByAThirdIsNoticed) {
  for (Eigen::Index unknown = 0; unknown < kUnknowns; ++unknown)
    EXPECT_LT(coverage(0.9, 2.0 / 3, unknown), 0.9 - band(0.9)) << unknown;
}

TEST(Posterior, IsTheNormalOneOfANormalModel) {
  const Toy some = draw_toy(20, 3);
  const double deviation = kNoise / std::sqrt(1 + kNoise * kNoise);
  double squares = 0, compared = 0;
  for (Eigen::Index i = 0; i < some.unknowns.rows(); ++i) {
    const Posterior posterior = estimator().estimate(row_of(some.summaries, i));
    EXPECT_NEAR(posterior.weights.sum(), 1, 1e-9);
    for (Eigen::Index k = 0; k < 2; ++k) {
      if (std::fabs(some.summaries(i, k)) > 2) continue;  // few draws are near
      const auto unknown = static_cast<std::size_t>(k);
      const double mean = some.summaries(i, k) / (1 + kNoise * kNoise);
      EXPECT_NEAR(posterior_quantile(posterior, unknown, 0.5), mean, 0.2);
      squares += std::pow(posterior_quantile(posterior, unknown, 0.5) - mean, 2);
      ++compared;
      const double width =
          posterior_quantile(posterior, unknown, 0.95) - posterior_quantile(posterior, unknown, 0.05);
      EXPECT_NEAR(width, 2 * 1.645 * deviation, 0.5 * deviation);
    }
    EXPECT_NEAR(posterior_quantile(posterior, 2, 0.95) - posterior_quantile(posterior, 2, 0.05), 2 * 1.645,
                0.4);
  }
  EXPECT_LT(std::sqrt(squares / compared), 0.25 * deviation);
}

TEST(Posterior, SaysWhatThePictureDetermines) {
  const std::vector<Unknown> unknowns = {{"a", "1", false}, {"b", "m", true}, {"c", "1", false}};
  const auto summaries =
      summarize(estimator(), estimator().estimate(row_of(draw_toy(1, 4).summaries, 0)), unknowns);
  const double exact = kNoise / std::sqrt(1 + kNoise * kNoise);  // of the prior's width, which is 1
  EXPECT_NEAR(summaries[0].width_share, exact, 0.12);
  EXPECT_EQ(summaries[0].determination, Determination::partly);
  EXPECT_GT(summaries[2].width_share, 0.85);
  EXPECT_EQ(summaries[2].determination, Determination::open);
  EXPECT_EQ(determination_of(0.4), Determination::determined);
  EXPECT_EQ(determination_of(0.8), Determination::partly);
  EXPECT_NEAR(summaries[2].prior_90.first, -1.645, 0.06);
  const auto prior = summarize(estimator(), prior_as_posterior(toy_table().unknowns), unknowns);
  for (const UnknownSummary& summary : prior) EXPECT_NEAR(summary.width_share, 1, 0.01);
}

/// Half a place beyond all draws, at either end; nothing within is called so.
TEST(Posterior, SaysWhichMediansLieBeyondNearlyAllOfThePrior) {
  const std::vector<Unknown> unknowns = {{"a", "1", false}, {"b", "m", true}, {"c", "1", false}};
  Posterior one;
  one.draws = {0};
  one.weights = Eigen::VectorXd::Ones(1);
  const auto is_at_end = [&](double share) {
    one.unknowns = Eigen::RowVector3d(estimator().prior_quantile(0, share), 0, 0);
    const auto summaries = summarize(estimator(), one, unknowns);
    EXPECT_FALSE(summaries[1].is_at_prior_end);
    return summaries[0].is_at_prior_end;
  };
  EXPECT_TRUE(is_at_end(0.998));
  EXPECT_TRUE(is_at_end(0.002));
  EXPECT_FALSE(is_at_end(0.99));
  EXPECT_FALSE(is_at_end(0.01));
}

TEST(Posterior, EqualDrawsComeInProportionToTheWeights) {
  Posterior posterior;
  posterior.draws = {4, 2, 9};
  posterior.weights = Eigen::Vector3d(0.5, 0.2, 0.3);
  posterior.unknowns = Eigen::MatrixXd::Zero(3, 1);
  std::array<int, 3> counts{};
  for (const std::size_t row : equal_draws(posterior, 100)) ++counts[row];
  EXPECT_EQ(counts, (std::array<int, 3>{50, 20, 30}));
}

TEST(Posterior, NumbersHaveThreeDigitsAndNoExponent) {
  EXPECT_EQ(number_in_words(0.012345), "0.0123");
  EXPECT_EQ(number_in_words(-4.5678), "-4.57");
  EXPECT_EQ(number_in_words(123456), "123000");
  EXPECT_EQ(number_in_words(-1005), "-1010");
  EXPECT_EQ(number_in_words(0), "0");
}

TEST(Posterior, NeedsATable) {
  EXPECT_THROW(PosteriorEstimator(toy_table().unknowns.topRows(100), toy_table().summaries.topRows(100)),
               InputError);
}

}  // namespace
}  // namespace espalier
