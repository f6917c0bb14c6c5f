// Do posteriors hold what they say? Trees are drawn from the prior and kept out of the table; the posterior
// of each is computed from its silhouette alone. Counted is how often an interval holds the truth and how far
// the posterior's median is from it (coverage.csv, a row an unknown; groups.csv, parameters and quantities),
// where the truth lies among the posterior's draws (ranks.csv, a row a tree, and ranks.png: uniform if all is
// well; Talts et al., arXiv:1804.06788, 2018; Modrák et al., Bayesian Analysis 20, 2025), and how often the
// intervals of a second table, of the next seed, overlap.
//   build/bin/posterior_calibration DIR [--truths 400] [--simulations 20000] [--seed 1]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <espalier/charts/line_chart.h>
#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/core/parallel_for.h>
#include <espalier/experiments/statistics/calibration_bands.h>
#include <espalier/experiments/statistics/quantiles.h>
#include <espalier/fitting/posterior/posterior_run.h>
#include <espalier/fitting/posterior/posterior_summary.h>
#include <espalier/fitting/posterior/simulations/reference_table.h>
#include <espalier/models/models.h>

#include "kept_table.h"
#include "program_main.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

struct CalibrationOptions {
  fs::path directory;
  std::size_t truths = 400, simulations = PosteriorRequest{}.simulations;
  Seed seed = 1;
  double height_m = 10;
};

/// Of one tree and one unknown.
struct Verdict {
  std::array<bool, kIntervals.size()> holds{};
  double rank = 0;         ///< share of the posterior below the truth
  double width_share = 0;  ///< of the 90 % interval, to the prior's
  double error = 0;        ///< of the median, as a share of the truth
  bool overlaps = false;   ///< the 90 % intervals of both tables
};

/// Of one unknown, over all trees.
struct Calibration {
  Unknown unknown;
  std::array<double, kIntervals.size()> coverage{};
  bool within_band = true;            ///< of each interval by itself
  bool within_joint_band = true;      ///< of its three intervals at once
  bool within_family_band = true;     ///< of those of all unknowns of its group at once
  bool within_rank_band = true;       ///< of its ranks at once
  double width_share = 0, error = 0;  ///< medians
  double overlap = 0;                 ///< share of the trees
};

std::vector<Verdict> judge(const PosteriorEstimator& estimator, const PosteriorEstimator& other,
                           const std::vector<Unknown>& unknowns, const Eigen::RowVectorXd& truth,
                           const Eigen::RowVectorXd& summaries) {
  const std::vector<double> observed(summaries.begin(), summaries.end());
  const Posterior posterior = estimator.estimate(observed);
  const auto summary = summarize(estimator, posterior, unknowns),
             second = summarize(other, other.estimate(observed), unknowns);
  std::vector<Verdict> verdicts(unknowns.size());
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const double value = truth[static_cast<Eigen::Index>(i)];
    for (std::size_t k = 0; k < kIntervals.size(); ++k)
      verdicts[i].holds[k] =
          summary[i].intervals[k].first <= value && value <= summary[i].intervals[k].second;
    const auto &a = summary[i].intervals.back(), &b = second[i].intervals.back();
    verdicts[i].overlaps = a.first <= b.second && b.first <= a.second;
    verdicts[i].rank = posterior_share(posterior, i, value);
    verdicts[i].width_share = summary[i].width_share;
    verdicts[i].error = std::fabs(summary[i].median - value) / std::max(std::fabs(value), 1e-12);
  }
  return verdicts;
}

/// Half the widths of bands, in standard deviations of a share, and the band of a curve of ranks: each is
/// kept to in 95 of 100 studies where all is well.
struct Bands {
  double one = 1.96, joint = 0;
  double family_of_parameters = 0, family_of_quantities = 0;
  RankBand ranks;
};

constexpr double kKept = 0.95;
constexpr std::size_t kRankPoints = 100;

/// Unknowns of a group are taken to stray together or apart, whichever is worse (Bonferroni).
Bands bands_of(const std::vector<Unknown>& unknowns, std::size_t truths) {
  const auto quantities = static_cast<double>(std::count_if(
      unknowns.begin(), unknowns.end(), [](const Unknown& unknown) { return unknown.is_quantity; }));
  const double parameters = static_cast<double>(unknowns.size()) - quantities;
  const auto joint = [&](double chance) { return joint_band_deviations(kIntervals, truths, chance); };
  return {.joint = joint(kKept),
          .family_of_parameters = joint(1 - (1 - kKept) / parameters),
          .family_of_quantities = joint(1 - (1 - kKept) / quantities),
          .ranks = rank_band(truths, kRankPoints, kKept)};
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

Calibration calibration_of(const Unknown& unknown, std::size_t index,
                           const std::vector<std::vector<Verdict>>& verdicts, const Bands& bands) {
  const auto over_trees = [&](auto get) {
    std::vector<double> values;
    values.reserve(verdicts.size());
    for (const std::vector<Verdict>& tree : verdicts) values.push_back(get(tree[index]));
    return values;
  };
  Calibration result{.unknown = unknown};
  for (std::size_t k = 0; k < kIntervals.size(); ++k) {
    result.coverage[k] =
        mean(over_trees([k](const Verdict& verdict) { return verdict.holds[k] ? 1.0 : 0.0; }));
    const double unit = std::sqrt(kIntervals[k] * (1 - kIntervals[k]) / static_cast<double>(verdicts.size()));
    const double strays = std::fabs(result.coverage[k] - kIntervals[k]) / unit - 1e-9;
    result.within_band &= strays <= bands.one;
    result.within_joint_band &= strays <= bands.joint;
    result.within_family_band &=
        strays <= (unknown.is_quantity ? bands.family_of_quantities : bands.family_of_parameters);
  }
  result.within_rank_band =
      is_within(bands.ranks, over_trees([](const Verdict& verdict) { return verdict.rank; }));
  result.width_share = median(over_trees([](const Verdict& verdict) { return verdict.width_share; }));
  result.error = median(over_trees([](const Verdict& verdict) { return verdict.error; }));
  result.overlap = mean(over_trees([](const Verdict& verdict) { return verdict.overlaps ? 1.0 : 0.0; }));
  return result;
}

std::string head_of_intervals() {
  std::string head;
  for (const double share : kIntervals) head += fmt::format(",coverage_{:g}", 100 * share);
  return head;
}

std::string coverage_csv(const std::vector<Calibration>& calibrations) {
  std::string csv = "unknown,group" + head_of_intervals() +
                    ",within_band,within_joint_band,within_family_band,within_rank_band,width_share_median,"
                    "error_median,overlap_90\n";
  for (const Calibration& row : calibrations) {
    csv += fmt::format("{},{}", row.unknown.name, row.unknown.is_quantity ? "quantities" : "parameters");
    for (const double covered : row.coverage) csv += fmt::format(",{:.4f}", covered);
    csv += fmt::format(",{:d},{:d},{:d},{:d},{:.4f},{:.4f},{:.4f}\n", row.within_band, row.within_joint_band,
                       row.within_family_band, row.within_rank_band, row.width_share, row.error, row.overlap);
  }
  return csv;
}

enum class Group { parameters, crown_parameters, quantities };

constexpr std::array<std::pair<Group, const char*>, 3> kGroups{{{Group::parameters, "parameters"},
                                                                {Group::crown_parameters, "crown_parameters"},
                                                                {Group::quantities, "quantities"}}};

/// Parameters of the crown: all but those of the branches of the second level and beyond.
bool is_in(Group group, const Unknown& unknown) {
  if (group == Group::quantities) return unknown.is_quantity;
  const bool is_fine = unknown.name.ends_with("[2]") || unknown.name.ends_with("[3]");
  return !unknown.is_quantity && (group == Group::parameters || !is_fine);
}

std::string group_row(Group group, const char* name, const std::vector<Calibration>& calibrations) {
  const auto over_group = [&](auto get) {
    std::vector<double> values;
    for (const Calibration& row : calibrations)
      if (is_in(group, row.unknown)) values.push_back(static_cast<double>(get(row)));
    return values;
  };
  const std::vector<double> within = over_group([](const Calibration& row) { return row.within_band; });
  std::string csv =
      fmt::format("{},{},{:.4f},{:.4f},{:.4f},{:.4f}", name, within.size(), mean(within),
                  mean(over_group([](const Calibration& row) { return row.within_joint_band; })),
                  mean(over_group([](const Calibration& row) { return row.within_family_band; })),
                  mean(over_group([](const Calibration& row) { return row.within_rank_band; })));
  for (std::size_t k = 0; k < kIntervals.size(); ++k)
    csv += fmt::format(",{:.4f}", mean(over_group([k](const Calibration& row) { return row.coverage[k]; })));
  return csv.append(fmt::format(",{:.4f},{:.4f},{:.4f}\n",
                                median(over_group([](const Calibration& row) { return row.width_share; })),
                                median(over_group([](const Calibration& row) { return row.error; })),
                                mean(over_group([](const Calibration& row) { return row.overlap; }))));
}

/// Means of coverage and overlap, medians of the others.
std::string groups_csv(const std::vector<Calibration>& calibrations) {
  std::string csv =
      "group,unknowns,within_band_share,within_joint_band_share,within_family_band_share,"
      "within_rank_band_share" +
      head_of_intervals() + ",width_share_median,error_median,overlap_90\n";
  for (const auto& [group, name] : kGroups) csv += group_row(group, name, calibrations);
  return csv;
}

std::string ranks_csv(const std::vector<Unknown>& unknowns,
                      const std::vector<std::vector<Verdict>>& verdicts) {
  std::string csv = "tree";
  for (const Unknown& unknown : unknowns) csv.append(",").append(unknown.name);
  csv += '\n';
  for (std::size_t tree = 0; tree < verdicts.size(); ++tree) {
    csv += fmt::format("{}", tree + 1);
    for (const Verdict& verdict : verdicts[tree]) csv += fmt::format(",{:.4f}", verdict.rank);
    csv += '\n';
  }
  return csv;
}

constexpr Rgb kParameterColor{0, 114, 178}, kQuantityColor{213, 94, 0}, kBandColor{20, 20, 20};

/// Of each unknown, how much the share of ranks below a rank exceeds that rank: zero where all is well.
LineChart rank_chart(const std::vector<Unknown>& unknowns, const std::vector<std::vector<Verdict>>& verdicts,
                     const RankBand& band) {
  ChartLine parameters{.name = "parameters", .color = kParameterColor, .dots = true, .points = {}};
  ChartLine quantities{
      .name = "quantities", .color = kQuantityColor, .width_px = 3, .dots = true, .points = {}};
  const auto trees = static_cast<double>(verdicts.size());
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    std::vector<double> ranks;
    ranks.reserve(verdicts.size());
    for (const std::vector<Verdict>& tree : verdicts) ranks.push_back(tree[i].rank);
    std::sort(ranks.begin(), ranks.end());
    for (std::size_t k = 0; k < ranks.size(); k += 4)
      (unknowns[i].is_quantity ? quantities : parameters)
          .points.emplace_back(ranks[k], (static_cast<double>(k) + 0.5) / trees - ranks[k]);
  }
  ChartLine outline{.name = "95 % band", .color = kBandColor, .points = {}};
  for (std::size_t i = 0; i < band.upper.size(); ++i) {
    const double rank = static_cast<double>(i + 1) / static_cast<double>(band.upper.size() + 1);
    outline.points.emplace_back(rank, band.upper[i] - rank);
  }
  for (std::size_t i = band.lower.size(); i-- > 0;) {
    const double rank = static_cast<double>(i + 1) / static_cast<double>(band.lower.size() + 1);
    outline.points.emplace_back(rank, band.lower[i] - rank);
  }
  outline.points.push_back(outline.points.front());
  return {"rank of the truth among draws of the posterior",
          "share of trees below, less the rank",
          {parameters, quantities, outline}};
}

PosteriorEstimator estimator_of(const ReferenceTable& table, std::size_t simulations) {
  const auto rows = static_cast<Eigen::Index>(simulations);
  return {table.unknowns.topRows(rows), table.summaries.topRows(rows)};
}

void calibrate(const CalibrationOptions& options) {
  const PlantPrior prior(model_by_name("weber_penn"));
  fs::create_directories(options.directory);
  const auto table_of = [&](Seed seed, std::size_t size) {
    return kept_table(options.directory / fmt::format("table_{}.bin", seed), prior, seed, options.height_m,
                      size);
  };
  const ReferenceTable table = table_of(options.seed, options.simulations + options.truths);
  const PosteriorEstimator estimator = estimator_of(table, options.simulations);
  const PosteriorEstimator other =
      estimator_of(table_of(options.seed + 1, options.simulations), options.simulations);
  const std::vector<Unknown> unknowns = unknowns_of(prior);
  std::vector<std::vector<Verdict>> verdicts(options.truths);
  parallel_for(options.truths, [&](std::size_t i) {
    const auto row = static_cast<Eigen::Index>(options.simulations + i);
    verdicts[i] = judge(estimator, other, unknowns, table.unknowns.row(row), table.summaries.row(row));
  });
  const Bands bands = bands_of(unknowns, options.truths);
  std::vector<Calibration> calibrations;
  calibrations.reserve(unknowns.size());
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    calibrations.push_back(calibration_of(unknowns[i], i, verdicts, bands));
  write_file_atomically(options.directory / "coverage.csv", coverage_csv(calibrations));
  write_file_atomically(options.directory / "groups.csv", groups_csv(calibrations));
  write_file_atomically(options.directory / "ranks.csv", ranks_csv(unknowns, verdicts));
  write_png(options.directory / "ranks.png", chart_to_picture(rank_chart(unknowns, verdicts, bands.ranks)));
  fmt::print("{}", groups_csv(calibrations));
}

/// The exit code.
int run(int argc, char** argv) {
  CalibrationOptions options;
  CLI::App app("Coverage of posteriors on trees drawn from their prior");
  app.add_option("directory", options.directory)->required();
  app.add_option("--truths", options.truths)->check(CLI::Range(10, 100'000));
  app.add_option("--simulations", options.simulations);
  app.add_option("--seed", options.seed);
  CLI11_PARSE(app, argc, argv);
  calibrate(options);
  return 0;
}

}  // namespace
}  // namespace espalier

int main(int argc, char** argv) { return espalier::run_program(argc, argv, espalier::run); }
