#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/core/parallel_for.h>
#include <espalier/fitting/posterior/predictive_check.h>
#include <espalier/fitting/posterior/simulations/plant_simulator.h>

namespace espalier {

namespace {

constexpr std::uint32_t kPurpose = 0x707063;  ///< keeps these plants apart from the table's

Eigen::RowVectorXd deviations(const Eigen::MatrixXd& rows) {
  const Eigen::RowVectorXd mean = rows.colwise().mean();
  return ((rows.rowwise() - mean).colwise().squaredNorm() / static_cast<double>(rows.rows())).cwiseSqrt();
}

/// The draw that a row of the posterior came from, with the row's parameters and random numbers of its own.
PlantDraw plant_of(const PlantPrior& prior, const ReferenceTable& table, const Posterior& posterior,
                   std::size_t row, std::size_t replicate) {
  const std::size_t draw = posterior.draws[row];
  PlantDraw plant = draw_of_row(prior, table.seed, draw, table.attempt[draw]);
  for (std::size_t i = 0; i < prior.rows().size(); ++i) {
    const ParameterInfo& info = prior.model().table().rows[prior.rows()[i]];
    const double value = posterior.unknowns(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i));
    plant.values[prior.rows()[i]] = whole_where_it_must(info, value);
  }
  plant.seed = random_bits(root_key(table.seed), kPurpose, static_cast<std::uint32_t>(replicate));
  return plant;
}

double median_of(Eigen::VectorXd values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Eigen::MatrixXd replicated_summaries(const PlantPrior& prior, const ReferenceTable& table,
                                     const Posterior& posterior, int threads) {
  const std::vector<std::size_t> rows = equal_draws(posterior, kReplicates);
  std::vector<std::vector<double>> summaries(rows.size());
  parallel_for(
      rows.size(),
      [&](std::size_t i) {
        PlantSimulator simulator(prior, table.height_m);
        Simulation simulation;
        if (simulator.simulate(plant_of(prior, table, posterior, rows[i], i), simulation))
          summaries[i] = simulation.summaries;
      },
      threads);
  std::erase_if(summaries, [](const std::vector<double>& row) { return row.empty(); });
  Eigen::MatrixXd replicates(static_cast<Eigen::Index>(summaries.size()), table.summaries.cols());
  for (Eigen::Index i = 0; i < replicates.rows(); ++i)
    replicates.row(i) = Eigen::Map<const Eigen::RowVectorXd>(summaries[static_cast<std::size_t>(i)].data(),
                                                             replicates.cols());
  return replicates;
}

PredictiveCheck check_prediction(const Eigen::MatrixXd& replicates, const Eigen::MatrixXd& table_summaries,
                                 const std::vector<double>& observed) {
  constexpr double kLeastShare = 0.05, kMostSquare = 16;
  ESPALIER_CHECK_EQ(replicates.cols(), static_cast<Eigen::Index>(observed.size()));
  if (replicates.rows() == 0) return {};
  const Eigen::RowVectorXd mean = replicates.colwise().mean();
  const Eigen::RowVectorXd unit =
      deviations(replicates).cwiseMax(kLeastShare * deviations(table_summaries)).cwiseMax(1e-12);
  const auto distance = [&](const Eigen::RowVectorXd& row) {
    return (row - mean).cwiseQuotient(unit).cwiseAbs2().cwiseMin(kMostSquare).sum();
  };
  Eigen::VectorXd distances(replicates.rows());
  for (Eigen::Index i = 0; i < replicates.rows(); ++i) distances[i] = distance(replicates.row(i));
  PredictiveCheck check;
  check.distance = distance(Eigen::Map<const Eigen::RowVectorXd>(observed.data(), replicates.cols()));
  check.usual = median_of(distances);
  const auto as_far = static_cast<double>((distances.array() >= check.distance).count());
  check.tail_share = (as_far + 1) / (static_cast<double>(replicates.rows()) + 1);
  return check;
}

namespace {

/// Summaries along the principal axes of the table, in standard deviations; axes along which plants hardly
/// differ are left out.
class WhiteSummaries {
 public:
  explicit WhiteSummaries(const Eigen::MatrixXd& table)
      : mean_(table.colwise().mean()), unit_(deviations(table).cwiseMax(1e-12)) {
    constexpr double kLeastVariance = 0.01;
    const Eigen::MatrixXd scaled = scale(table);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled.transpose() * scaled /
                                                                static_cast<double>(table.rows()));
    const Eigen::VectorXd& variances = solver.eigenvalues();  // the least first
    const Eigen::Index kept = (variances.array() > kLeastVariance).count();
    axes_ =
        solver.eigenvectors().rightCols(kept) * variances.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  }

  Eigen::MatrixXd operator()(const Eigen::MatrixXd& rows) const { return scale(rows) * axes_; }

 private:
  Eigen::MatrixXd scale(const Eigen::MatrixXd& rows) const {
    return (rows.rowwise() - mean_).array().rowwise() / unit_.array();
  }

  Eigen::RowVectorXd mean_, unit_;
  Eigen::MatrixXd axes_;
};

/// Squared distance to the fifth nearest row.
double distance_to_fifth(const Eigen::MatrixXd& rows, const Eigen::RowVectorXd& point) {
  constexpr Eigen::Index kFifth = 4;
  Eigen::VectorXd distances = (rows.rowwise() - point).rowwise().squaredNorm();
  std::nth_element(distances.begin(), distances.begin() + kFifth, distances.end());
  return distances[kFifth];
}

}  // namespace

double near_tail_share(const Eigen::MatrixXd& table_summaries, const std::vector<double>& observed) {
  constexpr Eigen::Index kCompared = 500;  // plants, held against all others
  const Eigen::Index compared = std::min(kCompared, table_summaries.rows() / 2);
  if (compared < 5) return 1;
  const WhiteSummaries white(table_summaries);
  const Eigen::MatrixXd plants = white(table_summaries);
  const Eigen::MatrixXd picture =
      white(Eigen::Map<const Eigen::RowVectorXd>(observed.data(), table_summaries.cols()));
  const Eigen::MatrixXd others = plants.bottomRows(plants.rows() - compared);
  const double distance = distance_to_fifth(others, picture);
  double as_alone = 1;
  for (Eigen::Index i = 0; i < compared; ++i)
    as_alone += distance_to_fifth(others, plants.row(i)) >= distance ? 1 : 0;
  return as_alone / (static_cast<double>(compared) + 1);
}

}  // namespace espalier
