#include <CLI/CLI.hpp>
#include <string>

#include <espalier/app/options/target_options.h>
#include <espalier/core/field_error.h>

namespace espalier {

std::shared_ptr<TargetOptions> add_target_options(CLI::App& command) {
  auto options = std::make_shared<TargetOptions>();
  command
      .add_option_function<std::string>(
          "--separation",
          [options](const std::string& text) {
            options->separation.method =
                in_field("separation", [&] { return parse_name<SeparationMethod>(text); });
          },
          "what tells the tree from the background: auto, alpha, luminance, background")
      ->default_str("auto");
  command
      .add_option_function<std::string>(
          "--tree-side",
          [options](const std::string& text) {
            options->separation.side = in_field("tree_side", [&] { return parse_name<TreeSide>(text); });
          },
          "which side of the threshold is the tree: auto, light (opaque), dark (transparent)")
      ->default_str("auto");
  command
      .add_option("--speck", options->speck_px,
                  "drop loose pieces under this many pixels of the picture (0: none; by default by its size)")
      ->check(CLI::Range(0, 1'000'000));
  command.add_flag("--fill-pinholes", options->fill_pinholes, "fill holes under the speck size");
  return options;
}

}  // namespace espalier
