#include <algorithm>
#include <numeric>

#include <espalier/fitting/posterior/posterior_summary.h>

namespace espalier {

namespace {

std::pair<double, double> interval(const Posterior& posterior, std::size_t unknown, double share) {
  return {posterior_quantile(posterior, unknown, 0.5 - 0.5 * share),
          posterior_quantile(posterior, unknown, 0.5 + 0.5 * share)};
}

double score_width(const PosteriorEstimator& estimator, std::size_t unknown, std::pair<double, double> ends) {
  return normal_quantile(estimator.prior_share(unknown, ends.second)) -
         normal_quantile(estimator.prior_share(unknown, ends.first));
}

}  // namespace

Determination determination_of(double width_share) {
  if (width_share <= kDeterminedWidth) return Determination::determined;
  return width_share <= kPartlyWidth ? Determination::partly : Determination::open;
}

std::vector<UnknownSummary> summarize(const PosteriorEstimator& estimator, const Posterior& posterior,
                                      const std::vector<Unknown>& unknowns) {
  std::vector<UnknownSummary> summaries;
  summaries.reserve(unknowns.size());
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    UnknownSummary summary{.unknown = unknowns[i],
                           .intervals = {},
                           .median = posterior_quantile(posterior, i, 0.5),
                           .prior_90 = {}};
    for (std::size_t k = 0; k < kIntervals.size(); ++k)
      summary.intervals[k] = interval(posterior, i, kIntervals[k]);
    summary.prior_90 = {estimator.prior_quantile(i, 0.05), estimator.prior_quantile(i, 0.95)};
    const double prior_width = score_width(estimator, i, summary.prior_90);
    if (prior_width > 0)
      summary.width_share = score_width(estimator, i, summary.intervals.back()) / prior_width;
    summary.determination = determination_of(summary.width_share);
    const double below = estimator.prior_share(i, summary.median);
    summary.is_at_prior_end = below < kPriorEnd || below > 1 - kPriorEnd;
    summaries.push_back(std::move(summary));
  }
  return summaries;
}

std::vector<SpeciesShare> species_shares(const PlantPrior& prior,
                                         const std::vector<std::uint32_t>& species_of_draws,
                                         const Posterior& posterior) {
  std::vector<SpeciesShare> shares;
  shares.reserve(prior.species().size());
  for (const Preset& preset : prior.species()) shares.push_back({preset.name, 0});
  for (std::size_t i = 0; i < posterior.draws.size(); ++i)
    shares[species_of_draws[posterior.draws[i]]].share += posterior.weights[static_cast<Eigen::Index>(i)];
  std::erase_if(shares, [](const SpeciesShare& species) { return species.share <= 0; });
  std::stable_sort(shares.begin(), shares.end(),
                   [](const SpeciesShare& a, const SpeciesShare& b) { return a.share > b.share; });
  return shares;
}

Posterior prior_as_posterior(const Eigen::MatrixXd& unknowns) {
  Posterior prior;
  prior.draws.resize(static_cast<std::size_t>(unknowns.rows()));
  std::iota(prior.draws.begin(), prior.draws.end(), std::size_t{0});
  prior.weights = Eigen::VectorXd::Constant(unknowns.rows(), 1.0 / static_cast<double>(unknowns.rows()));
  prior.unknowns = unknowns;
  return prior;
}

}  // namespace espalier
