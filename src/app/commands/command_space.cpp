// espalier space: the species space as a map, as a contact sheet, as a file; what it explains and what it
// leaves out.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/space_options.h>
#include <espalier/app/options/view_options.h>
#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/core/parallel_for.h>
#include <espalier/fitting/species_pictures/plant_pictures.h>
#include <espalier/fitting/species_pictures/space_plant.h>
#include <espalier/fitting/species_pictures/species_map.h>
#include <espalier/fitting/species_space/species_space_file.h>
#include <espalier/image/pictures/picture.h>

namespace espalier {

namespace {

struct SpaceCommandOptions {
  SpaceOptions space;
  int components = 0;
  std::string output, grid, save;
  int tile_px = 256;
  Seed seed = 1;
};

struct GridSize {
  int columns = 0, rows = 0;
};

/// "7x7", 1 to 40 each way.
GridSize parse_grid(const std::string& text) {
  const auto number = [](std::string_view part) {
    int value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc() && end == part.data() + part.size() ? value : 0;
  };
  const std::size_t cross = text.find('x');
  const GridSize grid{number(std::string_view(text).substr(0, cross)),
                      cross == text.npos ? 0 : number(std::string_view(text).substr(cross + 1))};
  if (grid.columns < 1 || grid.rows < 1 || grid.columns > 40 || grid.rows > 40)
    throw_input_error("--grid: got '{}', expected COLUMNSxROWS such as 7x7, 1 to 40 each", text);
  return grid;
}

void check_output(const SpaceCommandOptions& options) {
  if (options.output.empty()) {
    if (!options.grid.empty()) throw_input_error("--grid: got no picture to write, expected a PNG after it");
    return;
  }
  if (!options.grid.empty() || std::filesystem::path(options.output).extension() != ".svg")
    check_png_path(options.output);
}

/// The points of a grid over the species, the second coordinate growing upwards; other coordinates are 0.
Eigen::VectorXd grid_point(const SpeciesSpace& space, GridSize size, int column, int row) {
  Eigen::VectorXd lower = space.species[0].coordinates, upper = lower;
  for (const SpeciesPoint& species : space.species) {
    lower = lower.cwiseMin(species.coordinates);
    upper = upper.cwiseMax(species.coordinates);
  }
  const auto along = [&](Eigen::Index axis, int at, int count) {
    const double share = count > 1 ? static_cast<double>(at) / (count - 1) : 0.5;
    return lower[axis] + share * (upper[axis] - lower[axis]);
  };
  Eigen::VectorXd point = Eigen::VectorXd::Zero(space.dimension());
  point[0] = along(0, column, size.columns);
  if (space.dimension() > 1) point[1] = along(1, size.rows - 1 - row, size.rows);
  return point;
}

void write_sheet(const SpeciesSpace& space, const SpaceCommandOptions& options) {
  const GridSize size = parse_grid(options.grid);
  const TileView view{.size_px = options.tile_px, .seed = options.seed};
  const auto columns = static_cast<std::size_t>(size.columns),
             count = static_cast<std::size_t>(size.rows) * columns;
  std::vector<std::vector<PlantTile>> rows(static_cast<std::size_t>(size.rows),
                                           std::vector<PlantTile>(columns));
  parallel_for(count, [&](std::size_t i) {
    const Eigen::VectorXd point =
        grid_point(space, size, static_cast<int>(i % columns), static_cast<int>(i / columns));
    const std::string second = space.dimension() > 1 ? fmt::format(", {:.1f}", point[1]) : "";
    rows[i / columns][i % columns] = {growing_plant_at(space, point, view.budget, view.seed).values,
                                      fmt::format("{:.1f}{}", point[0], second)};
  });
  write_png(options.output, tile_picture(*space.model, rows, view));
}

void write_map(const SpeciesSpace& space, const std::string& path) {
  const SpeciesMap map = draw_species_map(space);
  if (std::filesystem::path(path).extension() == ".svg")
    write_file_atomically(path, layout_to_svg(map.layout, map.width_px, map.height_px));
  else
    write_png(path, layout_to_picture(map.layout, map.width_px, map.height_px));
}

void print_species(const SpeciesSpace& space, const ReconstructionError& error) {
  fmt::print("{:<18} {:>10}   coordinates\n", "species", "left out");
  for (std::size_t i = 0; i < space.species.size(); ++i) {
    const SpeciesPoint& species = space.species[i];
    std::string coordinates;
    for (const double coordinate : species.coordinates)
      coordinates += fmt::format("{}{:.3f}", coordinates.empty() ? "" : ", ", coordinate);
    fmt::print("{:<18} {:>10.3g}   {}\n", species.name, error.of_species[i], coordinates);
  }
}

void print_columns(const SpeciesSpace& space, const ReconstructionError& error) {
  constexpr std::size_t kShown = 8;
  std::vector<std::size_t> order(error.of_columns.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return error.of_columns[a] > error.of_columns[b]; });
  fmt::print("least well held:");
  for (std::size_t i = 0; i < std::min(kShown, order.size()); ++i)
    fmt::print("{} {} {:.3g}", i == 0 ? "" : ",", space.encoding->columns()[order[i]].name,
               error.of_columns[order[i]]);
  fmt::print("\nstrongest:");
  for (const Loading& loading : strongest_loadings(space, kShown)) {
    std::string numbers;
    for (const double number : loading.on_components)
      numbers += fmt::format("{}{:.2f}", numbers.empty() ? "" : ", ", number);
    fmt::print(" {} ({})", loading.column, numbers);
  }
  if (!error.constant_columns.empty())
    fmt::print("\nthe same in all, carried as they are: {}", fmt::join(error.constant_columns, ", "));
  fmt::print("\n");
}

void print_report(const SpeciesSpace& space) {
  fmt::print("{} presets of {}, encoding {}, {} of {} components\n", space.species.size(),
             space.model->table().model, space.encoding->name(), space.dimension(),
             space.pca.variance.size());
  double sum = 0;
  for (int i = 0; i < space.dimension(); ++i) {
    sum += space.pca.explained(i);
    fmt::print("component {}: {:.1f} % of the variance, {:.1f} % together\n", i + 1,
               100 * space.pca.explained(i), 100 * sum);
  }
  const ReconstructionError error = reconstruction_error(space);
  fmt::print("left out by these components, in standard deviations (root mean square):\n");
  print_species(space, error);
  print_columns(space, error);
}

void run_space(const SpaceCommandOptions& options) {
  check_output(options);
  if (!options.grid.empty()) parse_grid(options.grid);
  const SpeciesSpace space = load_space(options.space, options.components);
  if (!options.save.empty()) write_file_atomically(options.save, species_space_to_toml(space));
  if (!options.grid.empty())
    write_sheet(space, options);
  else if (!options.output.empty())
    write_map(space, options.output);
  print_report(space);
}

}  // namespace

void add_space_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "space", "The species space: a map, a contact sheet, what it explains and leaves out");
  const auto options = std::make_shared<SpaceCommandOptions>();
  command->add_option("picture", options->output,
                      "the map (SVG or PNG) or, with --grid, the sheet (PNG) to write");
  add_space_options(*command, options->space);
  command->add_option("--components", options->components, "dimensions of the space (default: 2)")
      ->check(CLI::Range(1, 10'000));
  command->add_option("--grid", options->grid, "draw the trees of the plane instead: COLUMNSxROWS");
  command->add_option("--tile", options->tile_px, "side of a tree of the sheet, px")
      ->check(CLI::Range(16, 2048))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "seed of the trees of the sheet")->capture_default_str();
  command->add_option("--save", options->save, "write the space to this TOML file");
  command->callback([options] { run_space(*options); });
}

}  // namespace espalier
