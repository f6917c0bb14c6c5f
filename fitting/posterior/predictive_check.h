// What tells a posterior from a narrow answer to a picture that no plant of the prior makes: whether plants
// of the posterior make pictures like it (Rubin, The Annals of Statistics 12, 1984; Gelman, Meng, Stern,
// Statistica Sinica 6, 1996), and whether any plant of the prior is near it.
#pragma once
#include <Eigen/Core>
#include <vector>

#include <espalier/fitting/posterior/posterior.h>
#include <espalier/fitting/posterior/simulations/plant_prior.h>
#include <espalier/fitting/posterior/simulations/reference_table.h>

namespace espalier {

struct PredictiveCheck {
  double distance = 0;  ///< of the picture's summaries from those of plants of the posterior
  double usual = 0;     ///< median distance of these plants among themselves
  double tail_share =
      1;  ///< of plants at least as far out as the picture, itself counted: 1/(n + 1) at least
  double near_tail_share = 1;  ///< of plants of the prior at least as far from all others as the picture
  bool is_likely() const { return tail_share > 0.01 && near_tail_share > 0.01; }
};

/// Plants of the posterior, each with random numbers of its own, that the check draws.
inline constexpr std::size_t kReplicates = 200;

/// Summaries of plants of the posterior, a row each; fewer where some do not grow. The same for any number of
/// threads (0: one a processor).
Eigen::MatrixXd replicated_summaries(const PlantPrior& prior, const ReferenceTable& table,
                                     const Posterior& posterior, int threads);

/// Distances are sums of squares over the summaries, each from the replicates' mean, in their standard
/// deviations and never in less than a twentieth of the table's: what hardly varies says little. No square
/// counts more than 16: one odd summary makes no odd picture.
PredictiveCheck check_prediction(const Eigen::MatrixXd& replicates, const Eigen::MatrixXd& table_summaries,
                                 const std::vector<double>& observed);

/// How alone the picture is among the plants of the prior: the share of plants that are at least as far from
/// their fifth nearest as the picture is, itself counted. Distances are between summaries along their
/// principal axes, in standard deviations (Box, Journal of the Royal Statistical Society A 143, 1980: the
/// prior predictive check).
double near_tail_share(const Eigen::MatrixXd& table_summaries, const std::vector<double>& observed);

}  // namespace espalier
