// How far what is counted of well calibrated intervals strays by chance: of several central intervals at
// once, and of all ranks at once.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace espalier {

/// Half the width of a band around each of `shares`, in standard deviations of its binomial share, such that
/// `trials` independent trials keep all shares of nested central intervals within with this chance or a
/// little more. Exact: sums over the multinomial counts. shares: three, rising, within (0, 1). Throws
/// InternalError.
double joint_band_deviations(std::span<const double> shares, std::size_t trials, double chance);

/// The band of an empirical distribution function of `count` uniform ranks, at 1/points, 2/points, … up to
/// below 1: its ends as shares. The whole curve lies within with this chance, found from 4,000 drawn curves.
/// Säilynoja, Bürkner, Vehtari, "Graphical test for discrete uniformity and its applications in
/// goodness-of-fit evaluation and multiple sample comparison" (Statistics and Computing 32, 2022).
struct RankBand {
  std::vector<double> lower, upper;
};
RankBand rank_band(std::size_t count, std::size_t points, double chance);

/// Whether the share of ranks up to each point lies in the band.
bool is_within(const RankBand& band, std::span<const double> ranks);

}  // namespace espalier
