// espalier render: grows one plant and writes a shaded picture of it.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/plant_options.h>
#include <espalier/app/options/view_options.h>
#include <espalier/core/error.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/render/shading/shaded.h>

namespace espalier {

namespace {

struct RenderCommandOptions {
  PlantOptions plant;
  ViewOptions view;
  ShadedSettings shading;
  std::string output;
};

void check_samples(int samples_per_px) {
  if (samples_per_px < 1 || samples_per_px > 1024)
    throw_input_error("--samples {}: expected 1 to 1024", samples_per_px);
}

void run_render(const RenderCommandOptions& options) {
  check_view(options.view);
  check_samples(options.shading.samples_per_px);
  check_png_path(options.output);
  const Plant plant = grow_plant(options.plant);
  const Camera camera = camera_of(options.view, plant);
  write_png(options.output, render_shaded(plant, camera, options.shading));
  fmt::print("{}: {}×{} px, {} stems, {} leaves\n", options.output, camera.width_px, camera.height_px,
             plant.stems.size(), plant.leaves.size());
}

}  // namespace

void add_render_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("render", "Grow a plant and write a shaded picture of it as a PNG");
  const auto options = std::make_shared<RenderCommandOptions>();
  add_plant_options(*command, options->plant);
  add_view_options(*command, options->view);
  command->add_option("-o,--output", options->output, "the PNG to write")->required();
  command->add_flag("--ground", options->shading.ground,
                    "a lawn; needs an elevation above 0 or --perspective");
  command->add_option("--samples", options->shading.samples_per_px, "rays a pixel, 1 to 1024")
      ->capture_default_str();
  command->callback([options] { run_render(*options); });
}

}  // namespace espalier
