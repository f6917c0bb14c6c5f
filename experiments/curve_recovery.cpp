// Are curves found again? Trees of one species with random curves are drawn and kept out of the table; the
// posterior of their curves is computed from each one's silhouette alone. curves.csv has a row a tree and
// number of a curve: the truth, the posterior's median and 90 % interval, and how much narrower it is than
// the prior's. recovery.csv says by species how far medians are from the truth where the posterior is narrow
// (determined, docs/posterior.md), and how often; SPECIES.svg shows the first tree's curves.
//   build/bin/curve_recovery DIR --species quaking_aspen … --free 'length_along[1]~4' … [--truths 1]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <espalier/charts/line_chart.h>
#include <espalier/core/curves/curve.h>
#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/fitting/posterior/posterior_summary.h>
#include <espalier/models/models.h>

#include "kept_table.h"
#include "program_main.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

struct RecoveryOptions {
  fs::path directory;
  std::vector<std::string> species, free;
  std::size_t truths = 1, simulations = 8000;
  Seed seed = 1;
  double height_m = 10;
};

/// Of one number of a curve of one tree.
struct Recovered {
  UnknownSummary summary;
  double truth = 0;

  double error() const { return summary.median - truth; }
};

using Tree = std::vector<Recovered>;

std::vector<Tree> recover(const RecoveryOptions& options, const PlantPrior& prior,
                          const ReferenceTable& table) {
  const auto rows = static_cast<Eigen::Index>(options.simulations);
  const PosteriorEstimator estimator(table.unknowns.topRows(rows), table.summaries.topRows(rows));
  const std::vector<Unknown> unknowns = unknowns_of(prior);
  std::vector<Tree> trees(options.truths);
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const Eigen::Index row = rows + static_cast<Eigen::Index>(i);
    const std::vector<double> observed(table.summaries.row(row).begin(), table.summaries.row(row).end());
    const auto summaries = summarize(estimator, estimator.estimate(observed), unknowns);
    for (std::size_t k = 0; k < summaries.size(); ++k)
      if (!unknowns[k].is_quantity)
        trees[i].push_back({summaries[k], table.unknowns(row, static_cast<Eigen::Index>(k))});
  }
  return trees;
}

std::string curves_csv(const std::string& species, const std::vector<Tree>& trees) {
  std::string csv;
  for (std::size_t i = 0; i < trees.size(); ++i)
    for (const Recovered& number : trees[i])
      csv += fmt::format("{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{}\n", species, i + 1,
                         number.summary.unknown.name, number.truth, number.summary.median,
                         number.summary.intervals.back().first, number.summary.intervals.back().second,
                         number.summary.width_share, name_of(number.summary.determination));
  return csv;
}

/// Errors by how narrow the posterior is.
struct Recovery {
  std::size_t numbers = 0, narrow = 0, held = 0;
  double narrow_squares = 0, squares = 0, largest = 0;

  void add(const Recovered& number) {
    const double square = number.error() * number.error();
    ++numbers;
    squares += square;
    held += number.summary.intervals.back().first <= number.truth &&
            number.truth <= number.summary.intervals.back().second;
    if (number.summary.determination != Determination::determined) return;
    ++narrow;
    narrow_squares += square;
    largest = std::max(largest, std::fabs(number.error()));
  }
};

double root_mean(double squares, std::size_t count) {
  return count == 0 ? NAN : std::sqrt(squares / static_cast<double>(count));
}

std::string recovery_row(const std::string& species, const Recovery& recovery) {
  return fmt::format("{},{},{},{:.4f},{:.4f},{:.4f},{:.4f}\n", species, recovery.numbers, recovery.narrow,
                     root_mean(recovery.narrow_squares, recovery.narrow), recovery.largest,
                     root_mean(recovery.squares, recovery.numbers),
                     static_cast<double>(recovery.held) / static_cast<double>(recovery.numbers));
}

constexpr Rgb kColors[] = {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}};

ChartLine line_of(const std::string& name, Rgb color, float width_px, const std::vector<double>& numbers) {
  constexpr int kSamples = 60;
  ChartLine line{.name = name, .color = color, .width_px = width_px, .points = {}};
  const Curve curve = make_curve(numbers);
  for (int k = 0; k <= kSamples; ++k)
    line.points.emplace_back(k / double{kSamples}, curve_value(curve, k / double{kSamples}));
  return line;
}

/// The truth as a thin line, the median as a thick one, the 90 % interval's ends as faint ones.
LineChart chart_of(const Tree& tree) {
  LineChart chart{"place along the stem", "value of the curve", {}};
  for (std::size_t first = 0; first < tree.size(); first += kCurveNumbers) {
    const Rgb color = kColors[first / kCurveNumbers % std::size(kColors)];
    const std::string& name = tree[first].summary.unknown.name;
    const std::string curve = name.substr(0, name.rfind('.'));
    const auto numbers = [&](auto get) {
      std::vector<double> values;
      for (std::size_t k = 0; k < kCurveNumbers; ++k) values.push_back(get(tree[first + k]));
      return values;
    };
    chart.lines.push_back(
        line_of(curve + ", truth", color, 1.5F, numbers([](const Recovered& n) { return n.truth; })));
    chart.lines.push_back(
        line_of(curve + ", median", color, 4, numbers([](const Recovered& n) { return n.summary.median; })));
    chart.lines.push_back(line_of(curve + ", lower 90 %", color, 0.5F, numbers([](const Recovered& n) {
                                    return n.summary.intervals.back().first;
                                  })));
    chart.lines.push_back(line_of(curve + ", upper 90 %", color, 0.5F, numbers([](const Recovered& n) {
                                    return n.summary.intervals.back().second;
                                  })));
  }
  return chart;
}

void measure(const RecoveryOptions& options) {
  fs::create_directories(options.directory);
  std::string curves = "species,tree,number,truth,median,lower_90,upper_90,width_share,determination\n";
  std::string recoveries = "species,numbers,narrow,narrow_rms,narrow_largest,all_rms,held_90\n";
  Recovery all;
  for (const std::string& species : options.species) {
    const PlantPrior prior(model_by_name("weber_penn"), {.species = {species}, .free = options.free});
    const ReferenceTable table =
        kept_table(options.directory / fmt::format("{}_{}.bin", species, options.seed), prior, options.seed,
                   options.height_m, options.simulations + options.truths);
    const std::vector<Tree> trees = recover(options, prior, table);
    Recovery recovery;
    for (const Tree& tree : trees)
      for (const Recovered& number : tree) recovery.add(number), all.add(number);
    curves += curves_csv(species, trees);
    recoveries += recovery_row(species, recovery);
    write_file_atomically(options.directory / (species + ".svg"), chart_to_svg(chart_of(trees.front())));
  }
  recoveries += recovery_row("all", all);
  write_file_atomically(options.directory / "curves.csv", curves);
  write_file_atomically(options.directory / "recovery.csv", recoveries);
  fmt::print("{}", recoveries);
}

/// The exit code.
int run(int argc, char** argv) {
  RecoveryOptions options;
  CLI::App app("Curves of trees drawn at random, found again from their silhouettes");
  app.add_option("directory", options.directory)->required();
  app.add_option("--species", options.species, "trees of each")->required();
  app.add_option("--free", options.free, "curves that are unknown")->required();
  app.add_option("--truths", options.truths, "trees of each species")->check(CLI::Range(1, 10'000));
  app.add_option("--simulations", options.simulations);
  app.add_option("--seed", options.seed);
  CLI11_PARSE(app, argc, argv);
  measure(options);
  return 0;
}

}  // namespace
}  // namespace espalier

int main(int argc, char** argv) { return espalier::run_program(argc, argv, espalier::run); }
