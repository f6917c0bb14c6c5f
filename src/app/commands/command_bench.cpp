// espalier bench: how fast evaluations are on this machine, and where their time goes.
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include <espalier/app/bench/bench_report.h>
#include <espalier/app/commands/commands.h>
#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/machine/processors.h>

namespace espalier {

namespace {

struct BenchOptions {
  double seconds = 0.4;
  std::string json, compare, only, plot;
};

/// Writes SVG, or PNG where the name ends so.
void write_plot(const std::filesystem::path& path, const LineChart& chart) {
  if (path.extension() == ".png")
    write_png(path, chart_to_picture(chart));
  else
    write_file_atomically(path, chart_to_svg(chart));
}

void run_bench_command(const BenchOptions& options) {
  if (!(options.seconds > 0))
    throw_input_error("--seconds: got {}, expected a positive number", options.seconds);
  const std::vector<OldBench> old =
      options.compare.empty() ? std::vector<OldBench>{} : read_bench_json(options.compare);
  std::vector<BenchCase> cases = bench_cases();
  std::erase_if(cases,
                [&](const BenchCase& c) { return !options.only.empty() && c.species != options.only; });
  if (cases.empty())
    throw_input_error("--species: got '{}', expected one of: {}", options.only,
                      fmt::join(bench_species(), ", "));
  const int threads = processors();
  fmt::print("{}", bench_table_head(threads));
  std::vector<BenchResult> results;
  for (const BenchCase& c : cases) {
    results.push_back(run_bench(c, options.seconds, threads));
    fmt::print("{}", bench_table_row(results.back()));
    std::fflush(stdout);
  }
  const std::vector<ScalingSeries> scaling = measure_scaling(options.seconds / 2, threads);
  fmt::print("{}", bench_scaling_line(scaling));
  if (!options.plot.empty()) write_plot(options.plot, scaling_chart(scaling));
  if (!old.empty()) fmt::print("\n{}", bench_ratios(results, old));
  if (!options.json.empty()) write_file_atomically(options.json, bench_to_json(results, scaling, threads));
}

}  // namespace

void add_bench_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("bench", "Measure how many candidates a second this machine evaluates");
  const auto options = std::make_shared<BenchOptions>();
  command->add_option("--seconds", options->seconds, "time for each case and number of threads")
      ->capture_default_str();
  command->add_option("--species", options->only, "one of the species only");
  command->add_option("--json", options->json, "also write the results, with a description of the machine");
  command->add_option("--plot", options->plot, "also draw how time grows, as .svg or .png");
  command->add_option("--compare", options->compare, "print ratios to an older report written by --json");
  command->callback([options] { run_bench_command(*options); });
}

}  // namespace espalier
