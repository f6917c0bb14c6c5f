// Do posteriors hold what they say? Trees are drawn from the prior and kept out of the table; the posterior
// of each is computed from its silhouette alone. Counted is how often an interval holds the truth
// (coverage.csv, a row an unknown), where the truth lies among the posterior's draws (ranks.csv, a row a
// tree: uniform if all is well; Talts et al., arXiv:1804.06788, 2018; Modrak et al., Bayesian Analysis 20,
// 2025), and how far the posterior's median is from the truth (errors.csv).
//   build/bin/posterior_calibration DIR [--truths 400] [--simulations 16000] [--seed 1]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/core/parallel_for.h>
#include <espalier/experiments/statistics/quantiles.h>
#include <espalier/fitting/posterior/posterior_summary.h>
#include <espalier/fitting/posterior/simulations/reference_table.h>
#include <espalier/models/models.h>

namespace espalier {
namespace {

namespace fs = std::filesystem;

struct CalibrationOptions {
  fs::path directory;
  std::size_t truths = 400, simulations = 16'000;
  Seed seed = 1;
  double height_m = 10;
};

/// Of one tree and one unknown.
struct Verdict {
  std::array<bool, kIntervals.size()> holds{};
  double rank = 0;         ///< share of the posterior below the truth
  double width_share = 0;  ///< of the 90 % interval, to the prior's
  double error = 0;        ///< of the median: |median - truth| / |truth|
};

double rank_of(const Posterior& posterior, std::size_t unknown, double truth) {
  double below = 0;
  for (Eigen::Index i = 0; i < posterior.weights.size(); ++i) {
    const double value = posterior.unknowns(i, static_cast<Eigen::Index>(unknown));
    below += posterior.weights[i] * (value < truth ? 1 : value == truth ? 0.5 : 0);
  }
  return below;
}

std::vector<Verdict> judge(const PosteriorEstimator& estimator, const std::vector<Unknown>& unknowns,
                           const Eigen::RowVectorXd& truth, const Eigen::RowVectorXd& summaries) {
  const Posterior posterior = estimator.estimate({summaries.begin(), summaries.end()});
  const std::vector<UnknownSummary> summary = summarize(estimator, posterior, unknowns);
  std::vector<Verdict> verdicts(unknowns.size());
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const double value = truth[static_cast<Eigen::Index>(i)];
    for (std::size_t k = 0; k < kIntervals.size(); ++k)
      verdicts[i].holds[k] =
          summary[i].intervals[k].first <= value && value <= summary[i].intervals[k].second;
    verdicts[i].rank = rank_of(posterior, i, value);
    verdicts[i].width_share = summary[i].width_share;
    verdicts[i].error = std::fabs(summary[i].median - value) / std::max(std::fabs(value), 1e-12);
  }
  return verdicts;
}

/// Half the width of the band that holds 95 % of counts of `truths` hits of chance `share`, as a share.
double binomial_band(double share, std::size_t truths) {
  return 1.96 * std::sqrt(share * (1 - share) / static_cast<double>(truths));
}

template <typename Get>
std::vector<double> column(const std::vector<std::vector<Verdict>>& verdicts, std::size_t unknown, Get get) {
  std::vector<double> values;
  values.reserve(verdicts.size());
  for (const std::vector<Verdict>& tree : verdicts) values.push_back(get(tree[unknown]));
  return values;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

std::string coverage_csv(const std::vector<Unknown>& unknowns,
                         const std::vector<std::vector<Verdict>>& verdicts) {
  std::string csv = "unknown,group";
  for (const double share : kIntervals) csv += fmt::format(",coverage_{:g}", 100 * share);
  csv += ",within_band,width_share_median,error_median\n";
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    csv += fmt::format("{},{}", unknowns[i].name, unknowns[i].is_quantity ? "quantity" : "parameter");
    bool within = true;
    for (std::size_t k = 0; k < kIntervals.size(); ++k) {
      const double covered =
          mean(column(verdicts, i, [k](const Verdict& verdict) { return verdict.holds[k] ? 1.0 : 0.0; }));
      within = within && std::fabs(covered - kIntervals[k]) <= binomial_band(kIntervals[k], verdicts.size());
      csv += fmt::format(",{:.4f}", covered);
    }
    csv +=
        fmt::format(",{},{:.4f},{:.4f}\n", within ? 1 : 0,
                    median(column(verdicts, i, [](const Verdict& verdict) { return verdict.width_share; })),
                    median(column(verdicts, i, [](const Verdict& verdict) { return verdict.error; })));
  }
  return csv;
}

/// A row a group: the share of its unknowns within the band, and medians over them.
std::string groups_csv(const std::vector<Unknown>& unknowns,
                       const std::vector<std::vector<Verdict>>& verdicts) {
  std::string csv = "group,unknowns,within_band_share";
  for (const double share : kIntervals) csv += fmt::format(",coverage_{:g}", 100 * share);
  csv += ",width_share_median,error_median\n";
  for (const bool is_quantity : {false, true}) {
    std::vector<double> within, widths, errors;
    std::array<std::vector<double>, kIntervals.size()> coverages;
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      if (unknowns[i].is_quantity != is_quantity) continue;
      bool in_band = true;
      for (std::size_t k = 0; k < kIntervals.size(); ++k) {
        coverages[k].push_back(
            mean(column(verdicts, i, [k](const Verdict& verdict) { return verdict.holds[k] ? 1.0 : 0.0; })));
        in_band = in_band && std::fabs(coverages[k].back() - kIntervals[k]) <=
                                 binomial_band(kIntervals[k], verdicts.size());
      }
      within.push_back(in_band ? 1 : 0);
      widths.push_back(
          median(column(verdicts, i, [](const Verdict& verdict) { return verdict.width_share; })));
      errors.push_back(median(column(verdicts, i, [](const Verdict& verdict) { return verdict.error; })));
    }
    csv += fmt::format("{},{},{:.4f}", is_quantity ? "quantity" : "parameter", within.size(), mean(within));
    for (const std::vector<double>& covered : coverages) csv += fmt::format(",{:.4f}", mean(covered));
    csv += fmt::format(",{:.4f},{:.4f}\n", median(widths), median(errors));
  }
  return csv;
}

std::string ranks_csv(const std::vector<Unknown>& unknowns,
                      const std::vector<std::vector<Verdict>>& verdicts) {
  std::string csv = "tree";
  for (const Unknown& unknown : unknowns) csv += "," + unknown.name;
  csv += '\n';
  for (std::size_t tree = 0; tree < verdicts.size(); ++tree) {
    csv += fmt::format("{}", tree + 1);
    for (const Verdict& verdict : verdicts[tree]) csv += fmt::format(",{:.4f}", verdict.rank);
    csv += '\n';
  }
  return csv;
}

void calibrate(const CalibrationOptions& options) {
  const PlantPrior prior(model_by_name("weber_penn"));
  fs::create_directories(options.directory);
  const fs::path path = options.directory / "table.bin";
  ReferenceTable table = read_table(path, prior, options.seed, options.height_m);
  const std::size_t wanted = options.simulations + options.truths;
  extend_table(
      prior, wanted, 0,
      [](std::size_t done, std::size_t all) {
        if (done % 2048 == 0) fmt::print(stderr, "{} of {} plants\n", done, all);
        return true;
      },
      table);
  write_table(path, prior, table);
  const auto known = static_cast<Eigen::Index>(options.simulations);
  const PosteriorEstimator estimator(table.unknowns.topRows(known), table.summaries.topRows(known));
  const std::vector<Unknown> unknowns = unknowns_of(prior);
  std::vector<std::vector<Verdict>> verdicts(options.truths);
  parallel_for(options.truths, [&](std::size_t i) {
    const Eigen::Index row = known + static_cast<Eigen::Index>(i);
    verdicts[i] = judge(estimator, unknowns, table.unknowns.row(row), table.summaries.row(row));
  });
  write_file_atomically(options.directory / "coverage.csv", coverage_csv(unknowns, verdicts));
  write_file_atomically(options.directory / "groups.csv", groups_csv(unknowns, verdicts));
  write_file_atomically(options.directory / "ranks.csv", ranks_csv(unknowns, verdicts));
  fmt::print("{}", groups_csv(unknowns, verdicts));
}

}  // namespace
}  // namespace espalier

int main(int argc, char** argv) {
  espalier::CalibrationOptions options;
  CLI::App app("Coverage of posteriors on trees drawn from their prior");
  app.add_option("directory", options.directory)->required();
  app.add_option("--truths", options.truths);
  app.add_option("--simulations", options.simulations);
  app.add_option("--seed", options.seed);
  CLI11_PARSE(app, argc, argv);
  try {
    espalier::calibrate(options);
  } catch (const espalier::InputError& error) {
    fmt::print(stderr, "posterior_calibration: {}\n", error.what());
    return 2;
  }
  return 0;
}
