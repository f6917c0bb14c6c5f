// The picture of a posterior's intervals: a row an unknown, over the share of the prior's plants below.
#pragma once
#include <vector>

#include <espalier/charts/chart_layout.h>
#include <espalier/fitting/posterior/posterior_summary.h>

namespace espalier {

struct PosteriorChart {
  ChartLayout layout;
  int width_px = 0, height_px = 0;
};

/// Three digits, without an exponent where it is large: "0.0123", "4.56", "123000".
std::string number_in_words(double number);

/// "12.3 [8.1, 20.4] m3": the median and the 90 % interval.
std::string interval_in_words(const UnknownSummary& summary);

/// Quantities first, then parameters, the best determined of both first.
std::vector<std::size_t> chart_order(const std::vector<UnknownSummary>& summaries);

/// The 90 % interval thin, the 50 % interval thick, the median black. `estimator` says where values lie among
/// the prior's.
PosteriorChart draw_intervals(const PosteriorEstimator& estimator,
                              const std::vector<UnknownSummary>& summaries);

}  // namespace espalier
