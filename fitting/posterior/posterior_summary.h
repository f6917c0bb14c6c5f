// A posterior in numbers and words: intervals of each unknown, and how much narrower they are than the
// prior's.
#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <espalier/core/names.h>
#include <espalier/fitting/posterior/posterior.h>
#include <espalier/fitting/posterior/simulations/plant_simulator.h>

namespace espalier {

/// By the width of the 90 % interval, as a share of the prior's, both in normal scores of the prior, so that
/// it does not matter in which unit or on which scale an unknown is measured.
enum class Determination { determined, partly, open };

template <>
inline constexpr auto kNames<Determination> =
    std::to_array<Name<Determination>>({{Determination::determined, "determined"},
                                        {Determination::partly, "partly"},
                                        {Determination::open, "open"}});

/// Widths up to these are determined, and partly so.
inline constexpr double kDeterminedWidth = 0.4, kPartlyWidth = 0.8;

Determination determination_of(double width_share);

struct UnknownSummary {
  Unknown unknown;
  std::array<std::pair<double, double>, kIntervals.size()> intervals;  ///< in the order of kIntervals
  double median = 0;
  std::pair<double, double> prior_90;
  double width_share = 1;
  Determination determination = Determination::open;
  /// The median lies beyond nearly all plants of the prior: the truth may lie farther still.
  bool is_at_prior_end = false;
};

/// A median with fewer of the prior's plants beyond it is at the prior's end.
inline constexpr double kPriorEnd = 0.005;

/// Of each unknown, in their order.
std::vector<UnknownSummary> summarize(const PosteriorEstimator& estimator, const Posterior& posterior,
                                      const std::vector<Unknown>& unknowns);

struct SpeciesShare {
  std::string species;
  double share = 0;  ///< of the posterior's weight on draws around it
};

/// The likeliest first; those without weight are left out.
std::vector<SpeciesShare> species_shares(const PlantPrior& prior,
                                         const std::vector<std::uint32_t>& species_of_draws,
                                         const Posterior& posterior);

/// All draws of the table alike, unchanged: what is known without a picture.
Posterior prior_as_posterior(const Eigen::MatrixXd& unknowns);

}  // namespace espalier
