// espalier compare: all measures of two pictures. Pictures of one size are compared pixel by pixel as
// masks; others, or all with --frame, are framed first as a fit would see them.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include <espalier/app/commands/commands.h>
#include <espalier/app/help_format.h>
#include <espalier/app/options/json_output.h>
#include <espalier/app/options/target_options.h>
#include <espalier/image/measures/compare.h>
#include <espalier/image/measures/metrics_json.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/image/reading/read_target.h>

namespace espalier {

namespace {

struct CompareOptions {
  std::string candidate, target, overlay;
  bool frame = false, json = false;
};

struct MaskPair {
  TargetPicture candidate, target;
  bool framed = false;
};

MaskPair read_pair(const CompareOptions& options, const TargetOptions& reading) {
  MaskPair pair{read_mask(options.candidate, reading), read_mask(options.target, reading), false};
  const Mask &a = pair.candidate.mask, &b = pair.target.mask;
  const bool same_size = a.width_px() == b.width_px() && a.height_px() == b.height_px();
  if (same_size && !options.frame) return pair;
  return {read_target(options.candidate, reading), read_target(options.target, reading), true};
}

void print_text(const CompareOptions& options, const MaskPair& pair, const MaskMetrics& metrics) {
  fmt::print("candidate           {}: {}\n", options.candidate, pair.candidate.how);
  fmt::print("target              {}: {}\n", options.target, pair.target.how);
  fmt::print("compared            {}×{} px, {}\n", pair.target.mask.width_px(), pair.target.mask.height_px(),
             pair.framed ? "framed" : "as they are");
  for (std::size_t row = 0; row < kMetricCount; ++row)
    fmt::print("{:<19} {:.6f}\n", kMetrics[row].name, metrics.values[row]);
}

void print_json(const CompareOptions& options, const MaskPair& pair, const MaskMetrics& metrics) {
  nlohmann::ordered_json json = {{"candidate", options.candidate},
                                 {"target", options.target},
                                 {"width_px", pair.target.mask.width_px()},
                                 {"height_px", pair.target.mask.height_px()},
                                 {"framed", pair.framed}};
  json.update(nlohmann::ordered_json(metrics));
  print_as_json(json);
}

void run_compare(const CompareOptions& options, const TargetOptions& reading) {
  const MaskPair pair = read_pair(options, reading);
  const MaskMetrics metrics = compare_masks(pair.candidate.mask, pair.target.mask);
  if (!options.overlay.empty()) write_png(options.overlay, overlay(pair.candidate.mask, pair.target.mask));
  (options.json ? print_json : print_text)(options, pair, metrics);
}

std::string help_of_measures() {
  std::string help = "Measures:\n";
  for (const Metric& metric : kMetrics)
    help += in_columns(
        fmt::format("  {}", metric.name),
        fmt::format("{} ({} is better)", metric.help, metric.better == Better::larger ? "larger" : "smaller"),
        23);
  return help;
}

}  // namespace

void add_compare_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("compare", "Print all measures of two pictures");
  command->footer(help_of_measures());
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("candidate", options->candidate, "a picture")->required();
  command->add_option("target", options->target, "the picture to compare it with")->required();
  command->add_flag("--frame", options->frame, "frame both, though they are of one size");
  command->add_flag("--json", options->json, "print JSON");
  command->add_option("--overlay", options->overlay,
                      "also write a PNG: agreement white, missed blue, surplus orange");
  const auto reading = add_target_options(*command);
  command->add_option("--size", reading->size_px, "side of the frame in pixels")->capture_default_str();
  command->callback([options, reading] { run_compare(*options, *reading); });
}

}  // namespace espalier
