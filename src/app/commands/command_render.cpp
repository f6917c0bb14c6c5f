// espalier render: grows one plant and writes a shaded picture of it.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/messages.h>
#include <espalier/app/options/plant_options.h>
#include <espalier/app/options/view_options.h>
#include <espalier/core/field_error.h>
#include <espalier/core/files.h>
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
  std::string background = "sky";
  std::string sun;  ///< "azimuth,elevation"; as usual where empty
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

/// Of --background: what stands behind the plant, or nothing.
void set_background(const std::string& name, ShadedSettings& shading) {
  if (name != "sky" && name != "white" && name != "transparent")
    throw_field_error("background", "got '{}', expected sky, white or transparent", name);
  if (name == "white") shading.background_top = shading.background_bottom = {1, 1, 1};
}

void set_sun(const std::string& text, ShadedSettings& shading) {
  if (text.empty()) return;
  const auto angles = parse_angles(text);
  if (!angles || angles->elevation_deg < 0 || angles->elevation_deg > 90 ||
      std::fabs(angles->azimuth_deg) > 360)
    throw_field_error("sun",
                      "got '{}', expected azimuth,elevation in degrees, such as -50,42, with 0 to 90 above "
                      "the horizon",
                      text);
  shading.sun_azimuth_deg = angles->azimuth_deg;
  shading.sun_elevation_deg = angles->elevation_deg;
}

void warn_of_unseen_ground(const ShadedSettings& shading, const ViewOptions& view) {
  if (shading.ground && !sees_ground(view))
    print_warning(
        "--ground has no effect: seen from the side without perspective a lawn is "
        "a line; give an elevation above 0 or --perspective");
}

void write_picture(const RenderCommandOptions& options, const Plant& plant, const Camera& camera,
                   const ShadedSettings& shading, const SceneObjects& objects) {
  if (options.background != "transparent")
    return write_png(options.output, render_shaded(plant, camera, shading, objects));
  const CutOut cut = render_cut_out(plant, camera, shading, objects);
  write_file_atomically(options.output, png_bytes(cut.picture, cut.cover));
}

void run_render(const RenderCommandOptions& options) {
  check_view(options.view);
  check_samples(options.shading.samples_per_px);
  check_png_path(options.output);
  if (!options.season.empty()) in_field("season", [&] { check_season(options.season); });
  ShadedSettings shading = options.shading;
  set_background(options.background, shading);
  set_sun(options.sun, shading);
  const SceneObjects objects = read_objects(options.objects);
  Plant plant = grow_plant(options.plant);
  if (!options.season.empty()) apply_season(options.season, plant, shading);
  apply_colors(colors_of(options.plant), options.season, shading);
  const Camera camera = camera_of(options.view, bounds(plant, objects));
  write_picture(options, plant, camera, shading, objects);
  warn_of_unseen_ground(shading, options.view);
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
                      "summer (as grown), autumn (leaves in the species' colour then), winter (bare) or "
                      "spring (young leaves)");
  command->add_flag("--ground", options->shading.ground,
                    "a lawn; needs an elevation above 0 or --perspective");
  command->add_option("--background", options->background, "sky, white or transparent")
      ->capture_default_str();
  command->add_option(
      "--sun", options->sun,
      "azimuth,elevation of the sun in degrees, the azimuth from the viewer and negative to the left "
      "(default: -50,42)");
  command->add_option("--samples", options->shading.samples_per_px, "rays a pixel, 1 to 1024")
      ->capture_default_str();
  command->callback([options] { run_render(*options); });
}

}  // namespace espalier
