#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <espalier/core/error.h>
#include <espalier/core/parallel_for.h>
#include <espalier/fitting/posterior/interval_factors.h>
#include <espalier/fitting/posterior/posterior.h>

namespace espalier {

namespace {

/// Share of the table that is near. Twice and three fifths as many are as sharp and cover as much.
constexpr double kNearShare = 0.08;
/// A line through them in forty dimensions takes so many, as long as they are not more than half of the
/// table.
constexpr double kLeastNear = 1500;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

void check_table(const Eigen::MatrixXd& unknowns, const Eigen::MatrixXd& summaries) {
  ESPALIER_CHECK_EQ(unknowns.rows(), summaries.rows());
  if (static_cast<std::size_t>(unknowns.rows()) < kLeastTableSize)
    throw_input_error("posterior: got {} simulations, expected {} or more", unknowns.rows(), kLeastTableSize);
}

struct Neighbours {
  std::vector<std::size_t> rows;  ///< the closest first, ties in the table's order
  Eigen::VectorXd weights;        ///< Epanechnikov's kernel, zero at the first row that is left out
};

/// Each row, less that of its part.
Eigen::MatrixXd less_parts(Eigen::MatrixXd rows, const Eigen::MatrixXd& of_parts) {
  for (Eigen::Index row = 0; row < rows.rows(); ++row)
    rows.row(row) -= of_parts.row(row % static_cast<Eigen::Index>(kParts));
  return rows;
}

constexpr Eigen::Index kNobody = -1;

/// `offsets`: of all draws from the picture; `itself`: a draw that is no neighbour.
Neighbours nearest(const Eigen::MatrixXd& offsets, Eigen::Index itself) {
  Eigen::VectorXd distances = offsets.rowwise().squaredNorm();
  if (itself != kNobody) distances[itself] = std::numeric_limits<double>::infinity();
  const auto rows = static_cast<double>(offsets.rows());
  const auto count = static_cast<std::size_t>(std::max(kNearShare * rows, std::min(kLeastNear, 0.5 * rows)));
  Neighbours near;
  near.rows.resize(static_cast<std::size_t>(offsets.rows()));
  std::iota(near.rows.begin(), near.rows.end(), std::size_t{0});
  const auto closer = [&](std::size_t a, std::size_t b) {
    return distances[index(a)] != distances[index(b)] ? distances[index(a)] < distances[index(b)] : a < b;
  };
  std::partial_sort(near.rows.begin(), near.rows.begin() + static_cast<std::ptrdiff_t>(count) + 1,
                    near.rows.end(), closer);
  const double reach = distances[index(near.rows[count])];
  near.rows.resize(count);
  near.weights.resize(index(count));
  for (std::size_t i = 0; i < count; ++i)
    near.weights[index(i)] = reach > 0 ? 1 - distances[index(near.rows[i])] / reach : 1;
  if (!(near.weights.sum() > 0)) near.weights.setOnes();  // all lie on one point
  near.weights /= near.weights.sum();
  return near;
}

Eigen::MatrixXd rows_of(const Eigen::MatrixXd& matrix, const std::vector<std::size_t>& rows) {
  Eigen::MatrixXd chosen(index(rows.size()), matrix.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) chosen.row(index(i)) = matrix.row(index(rows[i]));
  return chosen;
}

/// Weighted least squares of y on x, with a ridge: the values at x = 0, and each row's residual.
struct LocalLine {
  Eigen::RowVectorXd at_zero;
  Eigen::MatrixXd slopes, residuals;
};

LocalLine fit_line(const Eigen::MatrixXd& x, const Eigen::VectorXd& weights, const Eigen::MatrixXd& y,
                   double ridge) {
  const Eigen::RowVectorXd mean_x = weights.transpose() * x, mean_y = weights.transpose() * y;
  const Eigen::MatrixXd from_mean_x = x.rowwise() - mean_x, from_mean_y = y.rowwise() - mean_y;
  Eigen::MatrixXd normal = from_mean_x.transpose() * weights.asDiagonal() * from_mean_x;
  normal.diagonal().array() += ridge;
  LocalLine line;
  line.slopes = normal.ldlt().solve(from_mean_x.transpose() * weights.asDiagonal() * from_mean_y);
  line.at_zero = mean_y - mean_x * line.slopes;
  line.residuals = from_mean_y - from_mean_x * line.slopes;
  return line;
}

/// Residuals of the near draws as they would be had the draws shown the very picture: what the line through
/// all draws leaves of each, less what a line through the near ones makes of its offset, larger or smaller
/// there as residuals are on the way (Blum, François, Statistics and Computing 20, 2010). Residuals are as
/// much too small as the line has been fitted to them, and made so much larger.
Eigen::MatrixXd adjusted(const Eigen::MatrixXd& offsets, const Eigen::VectorXd& weights,
                         const Eigen::MatrixXd& residuals) {
  constexpr double kLeastSquare = 1e-6, kMostLog = 1.5;
  // Pictures share many of their near draws, so what a line has of chance is the same for all of them: a
  // ridge damps it.
  constexpr double kRidge = 0.2;
  // Logarithms of squares are rough: .5 covers .87 of 90 %, 3 .89, none .91.
  constexpr double kSpreadRidge = 3;
  const LocalLine line = fit_line(offsets, weights, residuals, kRidge);
  const Eigen::MatrixXd log_squares = line.residuals.array().square().max(kLeastSquare).log();
  const Eigen::MatrixXd growth = -offsets * fit_line(offsets, weights, log_squares, kSpreadRidge).slopes;
  const Eigen::MatrixXd scales = (0.5 * growth.array()).max(-kMostLog).min(kMostLog).exp();
  const double draws = 1 / weights.squaredNorm();  // as many of equal weight
  const double free_draws = std::max(1.0, draws - static_cast<double>(offsets.cols()) - 1);
  return (std::sqrt(draws / free_draws) * line.residuals.cwiseProduct(scales)).rowwise() + line.at_zero;
}

/// The value with this share below in each column.
Eigen::RowVectorXd column_quantiles(const Eigen::MatrixXd& columns, double share) {
  Eigen::RowVectorXd quantiles(columns.cols());
  for (Eigen::Index column = 0; column < columns.cols(); ++column) {
    Eigen::VectorXd values = columns.col(column);
    const auto place =
        values.begin() + static_cast<Eigen::Index>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    quantiles[column] = *place;
  }
  return quantiles;
}

/// Lines through plants say nothing far away from all of them.
constexpr double kEndShare = 0.001;

}  // namespace

namespace {

/// The unknown's draws in the order of their values.
std::vector<Eigen::Index> order_of(const Posterior& posterior, std::size_t unknown) {
  const auto values = posterior.unknowns.col(index(unknown));
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return values[a] < values[b]; });
  return order;
}

/// Moves the unknown's draws away from their median, or to it.
void widen(Posterior& posterior, std::size_t unknown, const IntervalFactors& factors) {
  const double median = posterior_quantile(posterior, unknown, 0.5);
  double below = 0;
  for (const Eigen::Index draw : order_of(posterior, unknown)) {
    const double weight = posterior.weights[draw], share = below + 0.5 * weight;
    below += weight;
    if (!(weight > 0)) continue;
    double& value = posterior.unknowns(draw, index(unknown));
    value =
        median + (value - median) * factor_at(factors, normal_quantile(std::clamp(share, 1e-9, 1 - 1e-9)));
  }
}

}  // namespace

PosteriorEstimator::PosteriorEstimator(const Eigen::MatrixXd& unknowns, const Eigen::MatrixXd& summaries,
                                       const TrainingSettings& training, int threads)
    : unknown_scores_of_((check_table(unknowns, summaries), unknowns)),
      summary_scores_of_(summaries),
      regression_(summary_scores_of_.scores(summaries), unknown_scores_of_.scores(unknowns), training,
                  threads),
      residuals_(unknown_scores_of_.scores(unknowns) - regression_.predictions_of_draws()),
      points_(regression_.points(regression_.predictions_of_draws())),
      lowest_(column_quantiles(regression_.predictions_of_draws(), kEndShare)),
      highest_(column_quantiles(regression_.predictions_of_draws(), 1 - kEndShare)) {
  factors_ = factors_from_witnesses(unknown_scores_of_.scores(unknowns), summary_scores_of_.scores(summaries),
                                    threads);
}

/// Posteriors of plants that no network has seen, themselves left out of the near ones.
std::vector<IntervalFactors> PosteriorEstimator::factors_from_witnesses(const Eigen::MatrixXd& unknown_scores,
                                                                        const Eigen::MatrixXd& summary_scores,
                                                                        int threads) const {
  const std::vector<Eigen::Index> witnesses = SummaryRegression::witnesses(unknown_scores.rows());
  Eigen::MatrixXd shares(index(witnesses.size()), unknown_scores.cols());
  parallel_for(
      witnesses.size(),
      [&](std::size_t i) {
        const Eigen::Index row = witnesses[i];
        const Posterior posterior = scores_near(summary_scores.row(row), row);
        for (Eigen::Index unknown = 0; unknown < unknown_scores.cols(); ++unknown)
          shares(index(i), unknown) =
              posterior_share(posterior, static_cast<std::size_t>(unknown), unknown_scores(row, unknown));
      },
      threads);
  std::vector<IntervalFactors> factors;
  factors.reserve(static_cast<std::size_t>(shares.cols()));
  for (const auto& of_unknown : shares.colwise())
    factors.push_back(interval_factors({of_unknown.begin(), of_unknown.end()}));
  return factors;
}

Posterior PosteriorEstimator::scores_near(const Eigen::RowVectorXd& summary_scores,
                                          Eigen::Index itself) const {
  Eigen::MatrixXd predicted = regression_.predict(summary_scores);
  for (auto part : predicted.rowwise()) part = part.cwiseMax(lowest_).cwiseMin(highest_);
  const Eigen::MatrixXd offsets = less_parts(points_, regression_.points(predicted));
  const Neighbours near = nearest(offsets, itself);
  const Eigen::MatrixXd errors =
      adjusted(rows_of(offsets, near.rows), near.weights, rows_of(residuals_, near.rows));
  return {near.rows, near.weights,
          (errors * regression_.shrinkage().asDiagonal()).rowwise() + predicted.colwise().mean()};
}

Posterior PosteriorEstimator::estimate(const std::vector<double>& summaries) const {
  ESPALIER_CHECK_EQ(summaries.size(), summary_scores_of_.size());
  Posterior posterior = scores_near(summary_scores_of_.scores(Eigen::Map<const Eigen::RowVectorXd>(
                                        summaries.data(), index(summaries.size()))),
                                    kNobody);
  for (std::size_t unknown = 0; unknown < factors_.size(); ++unknown)
    widen(posterior, unknown, factors_[unknown]);
  for (Eigen::Index column = 0; column < posterior.unknowns.cols(); ++column)
    for (double& score : posterior.unknowns.col(column))
      score = unknown_scores_of_[static_cast<std::size_t>(column)].value(score);
  return posterior;
}

double PosteriorEstimator::prior_quantile(std::size_t unknown, double share) const {
  return unknown_scores_of_[unknown].value(normal_quantile(share));
}

double PosteriorEstimator::prior_share(std::size_t unknown, double value) const {
  return normal_share(unknown_scores_of_[unknown].score(value));
}

double posterior_quantile(const Posterior& posterior, std::size_t unknown, double share) {
  const auto values = posterior.unknowns.col(index(unknown));
  const std::vector<Eigen::Index> order = order_of(posterior, unknown);
  double below = 0, last_middle = 0, last_value = values[order.front()];
  for (const Eigen::Index i : order) {
    const double middle = below + 0.5 * posterior.weights[i];
    if (middle >= share) {
      const double step = middle - last_middle;
      return step > 0 ? std::lerp(last_value, values[i], (share - last_middle) / step) : values[i];
    }
    below += posterior.weights[i];
    last_middle = middle;
    last_value = values[i];
  }
  return last_value;
}

double posterior_share(const Posterior& posterior, std::size_t unknown, double value) {
  double below = 0;
  for (Eigen::Index i = 0; i < posterior.weights.size(); ++i) {
    const double drawn = posterior.unknowns(i, index(unknown));
    below += posterior.weights[i] * (drawn < value ? 1 : drawn == value ? 0.5 : 0);
  }
  return below;
}

std::vector<std::size_t> equal_draws(const Posterior& posterior, std::size_t count) {
  std::vector<std::size_t> rows;
  rows.reserve(count);
  double reached = posterior.weights[0];
  std::size_t row = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    while (reached < share && row + 1 < posterior.draws.size()) reached += posterior.weights[index(++row)];
    rows.push_back(row);
  }
  return rows;
}

}  // namespace espalier
