// espalier mesh: grows one plant and writes it as a mesh for other programs.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/plant_options.h>
#include <espalier/core/error.h>
#include <espalier/plant/export.h>

namespace espalier {

namespace {

struct MeshCommandOptions {
  PlantOptions plant;
  std::string output;
  std::string detail = "medium";
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

void run_mesh(const MeshCommandOptions& options) {
  check_mesh_path(options.output);
  const float detail = parse_detail(options.detail);
  const PlantMesh mesh = mesh_plant(grow_plant(options.plant), {detail});
  write_mesh(mesh, options.output);
  fmt::print("{}: {} triangles of bark, {} of leaves, {} of blossom\n", options.output,
             mesh.bark.triangles.size(), mesh.leaves.triangles.size(), mesh.blossoms.triangles.size());
}

}  // namespace

void add_mesh_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("mesh", "Grow a plant and write it as a mesh: glb, obj, ply or stl");
  const auto options = std::make_shared<MeshCommandOptions>();
  add_plant_options(*command, options->plant);
  command->add_option("-o,--output", options->output, "the file; its extension chooses the format")
      ->required();
  command->add_option("--detail", options->detail, "low, medium, high, or 0 to 1")->capture_default_str();
  command->callback([options] { run_mesh(*options); });
}

}  // namespace espalier
