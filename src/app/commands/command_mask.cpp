// espalier mask: grows one plant and writes its silhouette.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/plant_options.h>
#include <espalier/app/options/view_options.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/render/embree/embree_renderer.h>
#include <espalier/render/silhouette.h>

namespace espalier {

namespace {

struct MaskCommandOptions {
  PlantOptions plant;
  ViewOptions view;
  std::string output;
};

void run_mask(const MaskCommandOptions& options) {
  check_view(options.view);
  check_png_path(options.output);
  const Plant plant = grow_plant(options.plant);
  const Camera camera = camera_of(options.view, plant);
  Mask mask;
  make_embree_renderer()->draw(plant, camera, mask);
  write_mask_png(options.output, mask);
  fmt::print("{}: {}×{} px, {} stems, {} leaves, {} px set\n", options.output, mask.width_px(),
             mask.height_px(), plant.stems.size(), plant.leaves.size(), area_px(mask));
}

}  // namespace

void add_mask_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("mask", "Grow a plant and write its silhouette as a PNG");
  const auto options = std::make_shared<MaskCommandOptions>();
  add_plant_options(*command, options->plant);
  add_view_options(*command, options->view);
  command->add_option("-o,--output", options->output, "the PNG to write")->required();
  command->callback([options] { run_mask(*options); });
}

}  // namespace espalier
