// espalier render: grows one plant and writes a shaded picture of it.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/plant_options.h>
#include <espalier/app/options/view_options.h>
#include <espalier/core/field_error.h>
#include <espalier/environment/scene_object.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/render/shading/seasons.h>

namespace espalier {

namespace {

struct RenderCommandOptions {
  PlantOptions plant;
  ViewOptions view;
  ShadedSettings shading;
  std::vector<std::string> objects;  ///< "mesh:FILE"
  std::string season;                ///< as the model grows it where empty
  std::string output;
};

void check_samples(int samples_per_px) {
  if (samples_per_px < 1 || samples_per_px > 1024)
    throw_input_error("--samples {}: expected 1 to 1024", samples_per_px);
}

SceneObjects read_objects(const std::vector<std::string>& texts) {
  SceneObjects objects;
  for (const std::string& text : texts) in_field("object", [&] { add_object(text, objects); });
  return objects;
}

void run_render(const RenderCommandOptions& options) {
  check_view(options.view);
  check_samples(options.shading.samples_per_px);
  check_png_path(options.output);
  if (!options.season.empty()) in_field("season", [&] { check_season(options.season); });
  const SceneObjects objects = read_objects(options.objects);
  Plant plant = grow_plant(options.plant);
  ShadedSettings shading = options.shading;
  if (!options.season.empty()) apply_season(options.season, plant, shading);
  const Camera camera = camera_of(options.view, bounds(plant, objects));
  write_png(options.output, render_shaded(plant, camera, shading, objects));
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
  command
      ->add_option("--object", options->objects,
                   "draw what stands beside the plant, too: mesh:FILE (metres), a closed mesh (repeatable)")
      ->allow_extra_args(false);
  command->add_option("--season", options->season,
                      "summer (as grown), autumn (coloured leaves), winter (bare) or spring (young leaves)");
  command->add_flag("--ground", options->shading.ground,
                    "a lawn; needs an elevation above 0 or --perspective");
  command->add_option("--samples", options->shading.samples_per_px, "rays a pixel, 1 to 1024")
      ->capture_default_str();
  command->callback([options] { run_render(*options); });
}

}  // namespace espalier
