// espalier target: shows what a fit will see of a picture, and says how that mask was made.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include <espalier/app/commands/commands.h>
#include <espalier/app/commands/target_sheet.h>
#include <espalier/app/options/messages.h>
#include <espalier/app/options/target_options.h>
#include <espalier/app/options/view_options.h>
#include <espalier/fitting/picture/crown_reading.h>
#include <espalier/fitting/picture/picture_reading.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/image/reading/label_picture.h>
#include <espalier/image/reading/read_target.h>

namespace espalier {

namespace {

struct TargetPaths {
  std::string image, output, labels = "auto", sheet;
  bool all_trees = false;

  /// --labels names a picture to write, where it is no choice.
  bool writes_labels() const { return labels != "auto" && labels != "none"; }
};

std::string stand_in_words(const PictureReading& reading) {
  if (reading.stand_height <= 0) return "";
  return fmt::format(", on a mound, pot or stand {:.2f} high", reading.stand_height);
}

/// What a fit reads off the mask before it grows anything.
std::string reading_in_words(const PictureReading& reading) {
  return fmt::format(
      "a {} tree{}: trunk {:.3f} wide, foot {:.3f}, crown {:.2f} wide from {:.2f} up (shares of its height); "
      "{:.0f} % of its outline and {:.0f} % of its convex hull covered; {} at the foot",
      name_of(reading.kind), stand_in_words(reading), reading.trunk_width, reading.foot_width,
      reading.crown_width, reading.crown_base, 100 * reading.cover, 100 * reading.hull_cover,
      reading.trunks == 1 ? "1 trunk" : fmt::format("{} trunks", reading.trunks));
}

void run_target(const TargetPaths& paths, const TargetOptions& options) {
  if (paths.writes_labels()) check_png_path(paths.labels);
  if (!paths.sheet.empty()) check_png_path(paths.sheet);
  const TargetPicture target = read_target(paths.image, options);
  write_mask_png(paths.output, target.mask);
  if (paths.writes_labels()) write_png(paths.labels, label_picture(target.mask, target.labels));
  if (!paths.sheet.empty())
    write_png(paths.sheet, target_sheet(decode_picture(paths.image, options.hints.frame), target));
  const double share = static_cast<double>(area_px(target.mask)) / options.size_px / options.size_px;
  fmt::print("{}: {}\n", paths.image, target.how);
  for (const std::string& fault : describe(target.faults, options.one_tree))
    print_warning(fmt::format("{}: {}", paths.image, fault));
  for (const std::string& warning : target.warnings)
    print_warning(fmt::format("{}: {}", paths.image, warning));
  for (const std::string& mark : target.left_out) fmt::print("{}: left out: {}\n", paths.image, mark);
  fmt::print("{}: confidence {:.2f}\n", paths.image, target.confidence);
  fmt::print("{}: {}×{} px, the tree is {:.1f} px tall and covers {:.1f} %\n", paths.output, options.size_px,
             options.size_px, target.tree_height_px, 100 * share);
  PictureReading reading = read_picture(target.mask);
  reading.kind = kind_with_labels(reading.kind, target.labels);
  fmt::print("{}: {}\n", paths.output, reading_in_words(reading));
  if (target.height_m)
    fmt::print("{}: by its scale bar the tree is {:.2f} m tall\n", paths.image, *target.height_m);
  if (reading.kind == TreeKind::leafy)
    fmt::print("{}: its crown, were it 10 m tall: {}\n", paths.output,
               crown_text(read_crown(target.mask, reading), 10));
  if (!target.labels.how.empty()) fmt::print("{}: {}\n", paths.image, target.labels.how);
}

}  // namespace

void add_target_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("target", "Show the mask that a fit will see of a picture");
  const auto paths = std::make_shared<TargetPaths>();
  command->add_option("image", paths->image, "the picture")->required();
  command->add_option("-o,--output", paths->output, "the mask to write (PNG)")->required();
  const auto options = add_target_options(*command);
  command->add_option("--size", options->size_px, "side of the square mask in pixels")->capture_default_str();
  command->add_flag("--all-trees", paths->all_trees,
                    "show several trees of a picture as one (default: the largest alone)");
  command
      ->add_option(
          "--labels", paths->labels,
          "auto or none, as in a fit, or a picture (PNG) to write of leaves, wood and what is in doubt")
      ->capture_default_str();
  command->add_option(
      "--sheet", paths->sheet,
      "also write a PNG: the picture, its tree and what was left out (orange), the mask, the labels");
  command->callback([paths, options] {
    options->labels = paths->labels == "none" ? LabelChoice::none : LabelChoice::automatic;
    options->one_tree = !paths->all_trees;
    run_target(*paths, *options);
  });
}

}  // namespace espalier
