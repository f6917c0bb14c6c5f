// Draws of a posterior, every unknown against every other: what the picture says of them together.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include <espalier/fitting/posterior/interval_chart.h>

namespace espalier {

/// The quantities and the best determined parameters, `count` in all or fewer.
std::vector<std::size_t> plotted_unknowns(const std::vector<UnknownSummary>& summaries, std::size_t count);

/// Dots below the diagonal, histograms on it. `samples`: equal draws, a row each, a column an unknown; axes
/// go from the least to the largest drawn.
PosteriorChart draw_pairs(const Eigen::MatrixXd& samples, const std::vector<UnknownSummary>& summaries,
                          const std::vector<std::size_t>& unknowns);

}  // namespace espalier
