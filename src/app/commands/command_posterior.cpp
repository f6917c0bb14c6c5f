// espalier posterior: what a picture says of the tree that it shows, as intervals of parameters and of what
// foresters measure.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/json_output.h>
#include <espalier/app/options/long_work.h>
#include <espalier/app/options/messages.h>
#include <espalier/app/options/target_options.h>
#include <espalier/app/version.h>
#include <espalier/core/field_error.h>
#include <espalier/fitting/posterior/posterior_run.h>
#include <espalier/fitting/posterior/simulations/silhouette_summaries.h>
#include <espalier/image/masks/mask_box.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

struct PosteriorOptions {
  PosteriorRequest request;
  std::string out;
  int threads = 0;
  bool quiet = false, json = false;
};

/// runs/fir-posterior, or the directory that was named, which is new, empty or of a posterior, which may have
/// been killed.
fs::path directory_of(const PosteriorOptions& options) {
  if (options.out.empty())
    return fs::path("runs") / (fs::path(options.request.picture).stem().string() + "-posterior");
  fs::path out = options.out;
  std::error_code ignored;
  if (!fs::exists(out, ignored) || fs::exists(out / "table.bin", ignored) ||
      fs::exists(out / "posterior.json", ignored))
    return out;
  if (!fs::is_directory(out, ignored) || holds_other_things(out))
    throw_input_error(
        "--output: got '{}', which holds other things, expected a new directory or one of a posterior",
        options.out);
  return out;
}

Mask read_silhouette(const PosteriorOptions& options, const TargetOptions& reading) {
  const TargetPicture picture = read_mask(options.request.picture, reading);
  const int height_px = box_of(picture.mask).height();
  if (!options.quiet && height_px < kSummaryFramePx)
    print_warning(fmt::format(
        "{}: the tree is {} px tall, expected {} or more: the prior's plants are drawn finer than it",
        options.request.picture, height_px, kSummaryFramePx));
  return picture.mask;
}

void print_posterior(const PosteriorResult& posterior, const PosteriorRequest& request,
                     const fs::path& directory) {
  if (!posterior.is_complete())
    fmt::print("stopped after {} of {} plants; the same command goes on\n", posterior.simulations,
               request.simulations);
  else
    fmt::print("{}files: {} (intervals.csv, samples.csv, parameters.svg, pairs.svg, posterior.json)\n",
               posterior_in_words(posterior), directory.string());
}

void run_posterior(PosteriorOptions& options, const TargetOptions& reading) {
  options.request.version = program_version() + " " + build_commit();
  check_request(options.request);
  const Mask silhouette = read_silhouette(options, reading);
  const fs::path directory = directory_of(options);
  watch_for_interrupt();
  ProgressLine line(options.quiet, 5);
  const TableProgress progress = [&line](std::size_t done, std::size_t wanted) {
    line.show([&] { return fmt::format("{} of {} plants of the prior", done, wanted); });
    return !is_interrupted();
  };
  const PosteriorResult posterior =
      compute_posterior(options.request, silhouette, directory, options.threads, progress);
  line.end();
  if (options.json && posterior.is_complete())
    print_summary_json(directory, "posterior.json");
  else if (!options.quiet)
    print_posterior(posterior, options.request, directory);
}

}  // namespace

void add_posterior_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "posterior", "What a picture says of its tree: intervals of parameters, volumes, areas and counts");
  const auto options = std::make_shared<PosteriorOptions>();
  PosteriorRequest& request = options->request;
  command->add_option("image", request.picture, "the picture")->required();
  command->add_option("-o,--output", options->out,
                      "directory to make or to go on with (default: runs/IMAGE-posterior)");
  command->add_option("--height", request.height_m, "height of the tree, in metres")->capture_default_str();
  command->add_option("--simulations", request.simulations, "plants of the prior to compare the picture with")
      ->capture_default_str();
  command->add_option("--samples", request.samples, "rows of samples.csv")->capture_default_str();
  command->add_option("--table", request.table,
                      "a file of these plants, made where there is none, for many pictures of one height "
                      "(default: table.bin in the directory)");
  command
      ->add_option("--species", request.prior.species,
                   "known species of the tree, or presets (default: any of the bundled)")
      ->delimiter(',');
  command
      ->add_option(
          "--free", request.prior.free,
          "parameters that are unknown: a,b[1],curve~4,default (default: what fits are free to change)")
      ->delimiter(',');
  command->add_option("--seed", request.seed, "seed of the plants of the prior")->capture_default_str();
  command->add_option("--threads", options->threads, "0: one per processor; changes the speed only")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command->add_flag("--quiet", options->quiet, "print nothing but errors");
  add_json_flag(*command, options->json);
  const auto reading = add_target_options(*command);
  reading->one_tree = true;
  command->callback([options, reading] { run_posterior(*options, *reading); });
}

}  // namespace espalier
