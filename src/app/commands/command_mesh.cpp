// espalier mesh: grows one plant and writes it as a mesh for other programs.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/json_output.h>
#include <espalier/app/options/plant_options.h>
#include <espalier/core/field_error.h>
#include <espalier/plant/export.h>
#include <espalier/plant/mesh_volume.h>
#include <espalier/render/shading/seasons.h>

namespace espalier {

namespace {

struct MeshCommandOptions {
  PlantOptions plant;
  std::string output;
  std::string detail = "medium";
  std::string up;      ///< "y" or "z"; empty: as is usual in files of the format
  std::string season;  ///< as the model grows it where empty
  bool volume = false, json = false;
};

constexpr std::array<std::pair<std::string_view, float>, 3> kDetails{
    {{"low", 0.0f}, {"medium", 0.5f}, {"high", 1.0f}}};

float parse_detail(const std::string& text) {
  for (const auto& [name, detail] : kDetails)
    if (name == text) return detail;
  float value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || !(value >= 0 && value <= 1))
    throw_input_error("--detail {}: expected low, medium, high or a number from 0 to 1", text);
  return value;
}

UpAxis parse_up(const MeshCommandOptions& options) {
  if (options.up.empty()) return usual_up_axis(options.output);
  if (options.up != "y" && options.up != "z")
    throw_field_error("up", "got '{}', expected y or z", options.up);
  return options.up == "y" ? UpAxis::y : UpAxis::z;
}

void print_mesh(const PlantMesh& mesh, UpAxis up, const MeshCommandOptions& options) {
  fmt::print("{}: {} triangles of bark, {} of leaves, {} of blossom; metres, {} is up\n", options.output,
             mesh.bark.triangles.size(), mesh.leaves.triangles.size(), mesh.blossoms.triangles.size(),
             up == UpAxis::y ? "y" : "z");
  if (!options.volume) return;
  const MeshVolume volume = measure_volume(mesh.bark);
  fmt::print("wood: {:.6g} m3; the sum of its tubes, which overlap at joints, is {:.6g} m3\n",
             volume.union_m3, volume.sum_m3);
}

void print_mesh_json(const PlantMesh& mesh, UpAxis up, const MeshCommandOptions& options) {
  nlohmann::ordered_json json = {{"file", options.output},
                                 {"unit", "m"},
                                 {"up", up == UpAxis::y ? "y" : "z"},
                                 {"triangles",
                                  {{"bark", mesh.bark.triangles.size()},
                                   {"leaves", mesh.leaves.triangles.size()},
                                   {"blossom", mesh.blossoms.triangles.size()}}}};
  if (options.volume) {
    const MeshVolume volume = measure_volume(mesh.bark);
    json["wood_m3"] = {{"union", volume.union_m3}, {"sum", volume.sum_m3}};
  }
  print_as_json(json);
}

void run_mesh(const MeshCommandOptions& options) {
  check_mesh_path(options.output);
  const float detail = parse_detail(options.detail);
  const UpAxis up = parse_up(options);
  check_up_axis(options.output, up);
  if (!options.season.empty()) in_field("season", [&] { check_season(options.season); });
  Plant plant = grow_plant(options.plant);
  ShadedSettings shading;
  if (!options.season.empty()) apply_season(options.season, plant, shading);
  const PlantMesh mesh = mesh_plant(plant, {detail});
  const PlantColors colors = colors_of(options.plant);
  write_mesh(
      mesh, options.output,
      {.up = up, .bark = colors.bark, .leaf = options.season == "autumn" ? colors.autumn : colors.leaf});
  (options.json ? print_mesh_json : print_mesh)(mesh, up, options);
}

}  // namespace

void add_mesh_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("mesh", "Grow a plant and write it as a mesh: glb, obj, ply or stl");
  const auto options = std::make_shared<MeshCommandOptions>();
  add_plant_options(*command, options->plant);
  command
      ->add_option(
          "-o,--output", options->output,
          "the file; its extension chooses the format: .glb or .obj (y is up), .ply or .stl (z is up). "
          "Lengths are "
          "metres; the trunk stands in the origin, and the front is seen from +z, or from -y where z is up")
      ->required();
  command->add_option("--detail", options->detail, "low, medium, high, or 0 to 1")->capture_default_str();
  command->add_option("--up", options->up,
                      "which axis points upwards: y or z (default: as is usual in files of the format)");
  command->add_option(
      "--season", options->season,
      "summer (as grown), autumn (leaves in the species' colour then), winter (bare) or spring");
  command->add_flag(
      "--volume", options->volume,
      "print the volume of the wood, too: of the union of its tubes, which overlap at joints, and their sum");
  add_json_flag(*command, options->json);
  command->callback([options] { run_mesh(*options); });
}

}  // namespace espalier
