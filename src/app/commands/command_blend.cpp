// espalier blend: the tree between two others, or at a point of the species space, as a preset or as
// pictures.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include <espalier/app/commands/commands.h>
#include <espalier/app/options/space_options.h>
#include <espalier/app/options/view_options.h>
#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/species_pictures/blend_strip.h>
#include <espalier/fitting/species_pictures/plant_pictures.h>
#include <espalier/fitting/species_pictures/space_plant.h>
#include <espalier/fitting/starts/thinning.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/models/models.h>

namespace espalier {

namespace {

constexpr double kFarthest = 1000;  ///< of a point; species lie within 10

struct BlendOptions {
  std::string a, b, t, at, output, compare;
  std::vector<std::string> strip;
  SpaceOptions space;
  int tile_px = 256;
  Seed seed = 1;
};

double parse_number(std::string_view text, const char* option, const std::string& whole) {
  double value = NAN;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw_input_error("{}: got '{}', expected finite numbers", option, whole);
  return value;
}

Eigen::VectorXd parse_point(const std::string& text) {
  std::vector<double> numbers;
  std::string_view rest = text;
  for (auto comma = rest.find(','); comma != rest.npos; comma = rest.find(',')) {
    numbers.push_back(parse_number(rest.substr(0, comma), "--at", text));
    rest.remove_prefix(comma + 1);
  }
  numbers.push_back(parse_number(rest, "--at", text));
  for (const double number : numbers)
    if (!(std::abs(number) <= kFarthest))
      throw_input_error("--at: got '{}', expected coordinates from -{:g} to {:g}", text, kFarthest,
                        kFarthest);
  return Eigen::Map<Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

struct Pair {
  Preset a, b;
  const Model& model;
};

Pair load_pair(const BlendOptions& options) {
  Preset a = load_preset(options.a), b = load_preset(options.b);
  if (!is_same_model(a.model, b.model))
    throw_input_error("blend: got {} of model {} and {} of model {}, expected one model", a.name, a.model,
                      b.name, b.model);
  const Model& model = model_by_name(a.model);
  return {std::move(a), std::move(b), model};
}

void write_blend(const BlendOptions& options) {
  const Pair pair = load_pair(options);
  const auto encoding = make_encoding(options.space.encoding, pair.model.table());
  const double t = parse_number(options.t, "--t", options.t);
  ParameterValues values = blend(pair.model, *encoding, pair.a.values, pair.b.values, t);
  const ParameterValues blended = values;
  if (t > 0 && t < 1 && !thin_until_grown(pair.model, {}, options.seed, values))
    throw_input_error("blend: got a tree too large to grow even when thinned, expected another --t");
  write_file_atomically(options.output,
                        preset_to_toml({fmt::format("{}_{}_{:g}", pair.a.name, pair.b.name, t),
                                        fmt::format("between {} and {} at t = {:g}, encoding {}", pair.a.name,
                                                    pair.b.name, t, encoding->name()),
                                        pair.a.model, values}));
  fmt::print("{}: {:g} of the way from {} to {}, encoding {}{}\n", options.output, t, pair.a.name,
             pair.b.name, encoding->name(), values == blended ? "" : "; thinned to the growth budget");
}

/// What had to be done to a plant that was too large, and how large it would have been.
std::string kept_to_budget(const GrowingPlant& plant, const GrowthBudget& budget,
                           const GrowthEstimate& wanted) {
  const std::string done = plant.moved_by > 0
                               ? fmt::format("moved {:.3g} of the way to {}", plant.moved_by, plant.nearest)
                               : "thinned";
  const std::string size = wanted.is_known
                               ? fmt::format("{:.0f} stems and {:.0f} leaves", wanted.stems, wanted.leaves)
                               : "more stems or leaves than any plant may have";
  return fmt::format(
      "{} to the growth budget of a fit, {:.0f} stems and {:.0f} leaves: it would have had {}\n", done,
      budget.max_stems, budget.max_leaves, size);
}

void print_plant(const BlendOptions& options, const GrowingPlant& plant) {
  fmt::print("{}: point {}, near {}, choices by the species' votes\n", options.output, options.at,
             plant.nearest);
  if (plant.outside > 0)
    fmt::print("{:.3g} outside the convex hull of the species\n", plant.outside);
  else
    fmt::print("inside the convex hull of the species\n");
  for (const ClampedValue& clamped : plant.clamped)
    fmt::print("clamped: {} from {:.6g} to {:.6g}\n", clamped.parameter, clamped.wanted, clamped.got);
}

void write_point(const BlendOptions& options) {
  const Eigen::VectorXd point = parse_point(options.at);
  const SpeciesSpace space = load_space(options.space, static_cast<int>(point.size()));
  const GrowthBudget budget = FitRecord{}.growth;
  const GrowingPlant plant = growing_plant_at(space, point, budget, options.seed);
  write_file_atomically(options.output,
                        preset_to_toml({std::filesystem::path(options.output).stem().string(),
                                        fmt::format("point {} of a species space of {} presets, encoding {}",
                                                    options.at, space.species.size(), space.encoding->name()),
                                        space.model->table().model, plant.values}));
  print_plant(options, plant);
  if (plant.thinned || plant.moved_by > 0)
    fmt::print("{}", kept_to_budget(plant, budget, wanted_size(space, plant, options.seed)));
}

std::vector<PlantTile> tiles_of(const Pair& pair, const std::string& encoding, int count,
                                const std::string& title, Seed seed) {
  const std::vector<ParameterValues> strip = blend_strip(
      pair.model, *make_encoding(encoding, pair.model.table()), pair.a.values, pair.b.values, count - 1);
  return strip_tiles(pair.model, strip, title, seed);
}

void write_strip(const BlendOptions& options) {
  int count = 0;
  const std::string& text = options.strip[0];
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 2 || count > 100)
    throw_input_error("--strip: got '{}', expected a number of trees, 2 … 100", text);
  check_png_path(options.strip[1]);
  const Pair pair = load_pair(options);
  const TileView view{.size_px = options.tile_px, .seed = options.seed};
  write_png(
      options.strip[1],
      tile_picture(pair.model, {tiles_of(pair, options.space.encoding, count, "", options.seed)}, view));
  fmt::print("{}: {} trees from {} to {}, encoding {}\n", options.strip[1], count, pair.a.name, pair.b.name,
             options.space.encoding);
}

void write_comparison(const BlendOptions& options) {
  constexpr int kTrees = 5;
  check_png_path(options.compare);
  const Pair pair = load_pair(options);
  std::vector<std::vector<PlantTile>> rows;
  for (const char* encoding : {"monotone", "raw"})
    rows.push_back(tiles_of(pair, encoding, kTrees, fmt::format("{}, ", encoding), options.seed));
  write_png(options.compare,
            tile_picture(pair.model, rows, {.size_px = options.tile_px, .seed = options.seed}));
  fmt::print("{}: from {} to {}, above monotone, below raw\n", options.compare, pair.a.name, pair.b.name);
}

void check_options(const BlendOptions& options) {
  const bool pictures = !options.strip.empty() || !options.compare.empty();
  if (options.at.empty() && options.b.empty())
    throw_input_error("blend: got {}, expected two presets, or --at X,Y",
                      options.a.empty() ? "nothing" : "one preset");
  if (!options.at.empty() && (!options.a.empty() || pictures))
    throw_input_error("--at: got presets or pictures too, expected a point and -o FILE only");
  if (!options.at.empty() && !options.t.empty())
    throw_input_error("--at: got --t too, expected one of the two");
  if (options.at.empty() && options.t.empty() && !pictures)
    throw_input_error("blend: got no --t, expected --t, --strip or --compare");
  if ((!options.at.empty() || !options.t.empty()) && options.output.empty())
    throw_input_error("blend: got no -o, expected a TOML file to write");
  if (options.t.empty() && options.at.empty() && !options.output.empty())
    throw_input_error("-o: got no --t, expected --t or --at");
}

void run_blend(const BlendOptions& options) {
  check_options(options);
  if (!options.at.empty()) return write_point(options);
  if (!options.t.empty()) write_blend(options);
  if (!options.strip.empty()) write_strip(options);
  if (!options.compare.empty()) write_comparison(options);
}

}  // namespace

void add_blend_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("blend", "The tree between two others, or at a point of the species space");
  const auto options = std::make_shared<BlendOptions>();
  command->add_option("preset", options->a, "a bundled preset (see: espalier species) or a TOML file");
  command->add_option("other", options->b, "the preset at t = 1");
  command->add_option("--t", options->t, "how far from the first to the other, 0 … 1");
  command->add_option("--at", options->at, "coordinates in the species space instead of presets: X,Y[,…]");
  command->add_option("-o,--output", options->output, "the preset to write (TOML)");
  command->add_option("--strip", options->strip, "N FILE.png: a picture of N trees from t = 0 to t = 1")
      ->expected(2);
  command->add_option("--compare", options->compare, "FILE.png: a strip of each encoding");
  add_space_options(*command, options->space);
  command->add_option("--tile", options->tile_px, "side of a tree of a picture, px")
      ->check(CLI::Range(16, 2048))
      ->capture_default_str();
  command
      ->add_option("--seed", options->seed,
                   "seed of the trees of pictures, and of the one that a growth budget is kept to")
      ->capture_default_str();
  command->callback([options] { run_blend(*options); });
}

}  // namespace espalier
