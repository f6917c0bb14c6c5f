// Options of commands that grow one plant: preset, seed, changed parameters, pruning volume.
#include <CLI/CLI.hpp>
#include <sstream>

#include <espalier/app/options/plant_options.h>
#include <espalier/core/assignment.h>
#include <espalier/core/curves/parameter_curves.h>
#include <espalier/core/field_error.h>
#include <espalier/environment/volume.h>
#include <espalier/lsystem/derivation/derivation.h>
#include <espalier/lsystem/files/bundled.h>
#include <espalier/models/grow_preset.h>
#include <espalier/models/models.h>

namespace espalier {

namespace {

/// "[0.4, 1, 0.2, 1]" or "0.4,1,0.2,1".
std::vector<double> parse_numbers(const std::string& text) {
  std::string plain = text;
  std::erase(plain, ' ');
  if (plain.starts_with('[') && plain.ends_with(']')) plain = plain.substr(1, plain.size() - 2);
  std::vector<double> numbers;
  std::istringstream parts(plain);
  for (std::string part; std::getline(parts, part, ',');) {
    const auto number = parse_decimal(part);
    if (!number) throw_input_error("got '{}', expected 1, 4, 5 or 7 numbers with commas between", text);
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace

void set_parameters(const std::vector<std::string>& assignments, const ParameterTable& table,
                    ParameterValues& values) {
  for (const std::string& text : assignments)
    in_field("set", [&] {
      const Assignment assignment = parse_assignment(text);
      if (const CurveInfo* curve = table.find_curve(assignment.name))
        return set_curve(table, *curve, parse_numbers(assignment.value), text, values);
      const std::size_t row = table.index_of(assignment.name);
      values[row] = parse_parameter_value(table.rows[row], assignment.value);
      check_densities(table, values, text);
    });
}

void add_plant_options(CLI::App& command, PlantOptions& options) {
  command
      .add_option(
          "preset", options.preset,
          "a bundled preset (see: espalier species), a TOML file, an .lsys file, or a bundled L-system with "
          "its ending, such as fern.lsys (see: espalier lsystem --list)")
      ->required();
  command.add_option("--seed", options.seed, "seed of the random numbers (default: the preset's, or 1)");
  command
      .add_option(
          "--set", options.assignments,
          "change a parameter: name=value, of a curve 1, 4, 5 or 7 numbers: name=0.5,1,1,0.2 (repeatable)")
      ->allow_extra_args(false);
  command.add_option("--steps", options.steps, "derivation steps of an L-system; else those the file says");
  command.add_option(
      "--prune-to", options.prune_to,
      "keep the plant inside box:cx,cy,cz,sx,sy,sz, ball:cx,cy,cz,r, cylinder:cx,cy,cz,r,h, "
      "mesh:FILE (metres), an expression such as \"union(ball(0,0,4, 2), box(0,0,1, 1,1,2))\" or "
      "\"crown(top = 12, bottom = 3, radius = 4)\", or "
      "FILE.lsys:NAME, a volume of an L-system; an L-system's own volume 'clip' becomes this one");
}

std::unique_ptr<Volume> read_volume(const std::string& text) {
  const std::size_t end = text.rfind(".lsys:");
  if (end == std::string::npos) return parse_volume(text);
  const std::string file = text.substr(0, end + 5), name = text.substr(end + 6);
  const lsystem::Grammar grammar = lsystem::load_grammar(file);
  lsystem::Derivation derivation(grammar);
  derivation.start(1);
  return make_scaled(static_cast<float>(derivation.settings().unit_m), derivation.volume(name));
}

PlantColors colors_of(const PlantOptions& options) { return load_preset(options.preset).colors; }

Plant grow_plant(const PlantOptions& options) {
  if (options.steps && *options.steps < 0)
    throw_input_error("--steps {}: expected 0 or more", *options.steps);
  Preset preset = load_preset(options.preset);
  const Model& model = model_by_name(preset.model);
  set_parameters(options.assignments, model.table(), preset.values);
  const std::unique_ptr<Volume> volume = options.prune_to.empty() ? nullptr : read_volume(options.prune_to);
  return grow_preset(preset, options.preset,
                     {.seed = options.seed, .prune_to = volume.get(), .steps = options.steps});
}

}  // namespace espalier
