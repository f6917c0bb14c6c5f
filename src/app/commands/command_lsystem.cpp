// espalier lsystem: derives an L-system file and prints its string, draws it, or draws its growth.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include <espalier/app/commands/commands.h>
#include <espalier/app/growth_frames.h>
#include <espalier/app/help_format.h>
#include <espalier/app/options/json_output.h>
#include <espalier/app/options/messages.h>
#include <espalier/app/options/plant_options.h>
#include <espalier/app/options/view_options.h>
#include <espalier/core/assignment.h>
#include <espalier/core/field_error.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/lsystem/derivation/derivation.h>
#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/bundled.h>
#include <espalier/lsystem/strings/turtle_commands.h>
#include <espalier/render/shading/shaded.h>

namespace espalier {

namespace {

struct LsystemOptions {
  std::string file;
  bool list = false, json = false;
  std::optional<int> steps;
  Seed seed = 1;
  std::vector<std::string> assignments, volumes;
  bool print_string = false;
  std::optional<int> frames;
  double frame_seconds = 0.1;
  std::string output;
  ViewOptions view;
  ShadedSettings shading;
  lsystem::Limits limits;
};

/// --volume name=text, metres.
void replace_volume(const std::string& assignment, double unit_m, lsystem::Derivation& derivation) {
  const Assignment given = in_field("volume", [&] { return parse_assignment(assignment); });
  VolumePtr volume = read_volume(given.value);
  derivation.replace_volume(given.name, make_scaled(static_cast<float>(1 / unit_m), std::move(volume)));
}

void draw(const Plant& plant, const Camera& camera, const LsystemOptions& options, const std::string& path) {
  write_png(path, render_shaded(plant, camera, options.shading));
  fmt::print("{}: {}×{} px, {} stems, {} leaves\n", path, camera.width_px, camera.height_px,
             plant.stems.size(), plant.leaves.size());
}

Plant plant_of(lsystem::Derivation& derivation) {
  Plant plant;
  const lsystem::ModuleString& drawn = derivation.interpreted();
  lsystem::build_plant(drawn, derivation.alphabet(), derivation.settings(), plant, derivation.work());
  return plant;
}

GrowthFrames frames_of(const LsystemOptions& options) {
  return {options.frames.value_or(1), options.frame_seconds, options.output};
}

void check_options(const LsystemOptions& options) {
  if (options.print_string && options.frames)
    throw_input_error("got both --string and --frames, expected one of them");
  if (options.print_string == !options.output.empty())
    throw_input_error("got {} --string and --output, expected one of them: the string, or a picture to draw",
                      options.print_string ? "both" : "neither");
  if (options.steps && *options.steps < 0)
    throw_input_error("--steps {}: expected 0 or more", *options.steps);
  if (!(options.limits.lua_instructions >= 0))
    throw_input_error("--max-lua {}: expected 0 or more", options.limits.lua_instructions);
  if (options.frames) check_growth_frames(frames_of(options));
  if (options.print_string) return;
  check_view(options.view);
  if (!options.frames) check_png_path(options.output);
}

void list_bundled(bool as_json) {
  auto rows = nlohmann::ordered_json::array();
  for (const std::string& name : lsystem::bundled_names())
    rows.push_back({{"name", name}, {"description", lsystem::bundled_description(name)}});
  if (as_json) return print_as_json(rows);
  for (const std::string& name : lsystem::bundled_names())
    fmt::print("{:<24} {}\n", name, lsystem::bundled_description(name));
}

/// Of a file that does not say whether its segments are leafy: those of earlier versions were.
void warn_of_ignored_leaves(const lsystem::Grammar& grammar, const lsystem::SymbolTable& alphabet) {
  for (std::size_t id = 0; id < alphabet.size() && !grammar.leafy_segments; ++id) {
    const lsystem::Symbol& symbol = alphabet[static_cast<lsystem::SymbolId>(id)];
    if (symbol.arity < 3 || (symbol.name != "F" && symbol.name != "G")) continue;
    print_warning(
        fmt::format("{}: {} has {} parameters, of which length and width are drawn; write "
                    "'segments: leafy' where the third is a number of leaves, else 'segments: plain'",
                    grammar.name, symbol.name, symbol.arity));
    return;
  }
}

/// Functions of files are taken over by a few numbers, which follow them nearly.
void note_errors_of_functions(const lsystem::Grammar& grammar) {
  for (const lsystem::FunctionDeclaration& function : grammar.functions)
    if (!function.file.empty())
      print_message(
          fmt::format("{}: 7 numbers follow the function within {:.2g}", function.file, function.error));
}

void run_lsystem(const LsystemOptions& options) {
  const bool asks_for_nothing = options.file.empty() && !options.print_string && options.output.empty();
  if (options.list || asks_for_nothing) return list_bundled(options.json);
  if (options.file.empty())
    throw_input_error(
        "got no file, expected an .lsys file or the name of a bundled one (see: espalier lsystem)");
  const lsystem::Grammar grammar = lsystem::load_grammar(options.file);
  check_options(options);
  note_errors_of_functions(grammar);
  ParameterValues values = grammar.parameters.defaults();
  set_parameters(options.assignments, grammar.parameters, values);
  lsystem::Derivation derivation(grammar, options.limits);
  derivation.start(values, options.seed);
  const double unit_m = derivation.settings().unit_m;
  for (const std::string& volume : options.volumes) replace_volume(volume, unit_m, derivation);
  if (!options.volumes.empty()) derivation.start(values, options.seed);
  const int steps = options.steps.value_or(derivation.settings().steps);
  if (options.frames)
    write_growth_frames(derivation, values, options.seed, steps, options.view, options.shading,
                        frames_of(options));
  else
    derivation.run(steps);
  warn_of_ignored_leaves(grammar, derivation.alphabet());
  if (options.frames) return;
  if (options.print_string) return fmt::print("{}\n", derivation.text());
  const Plant plant = plant_of(derivation);
  draw(plant, camera_of(options.view, plant), options, options.output);
}

std::string help_of_commands() {
  std::string help = "Symbols that the turtle knows:\n";
  for (const lsystem::CommandInfo& info : lsystem::kCommands)
    help +=
        in_columns(fmt::format("  {:<2} {:<1}", info.symbol, info.other_symbol), std::string(info.help), 8);
  return help;
}

}  // namespace

void add_lsystem_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("lsystem", "List the bundled L-systems, or derive one: print its string or draw it");
  command->footer(help_of_commands());
  const auto options = std::make_shared<LsystemOptions>();
  command->add_option("file", options->file, "an .lsys file, or the name of a bundled one");
  command->add_flag("--list", options->list,
                    "list the bundled L-systems, with what each is, as without a file");
  command->add_flag("--json", options->json, "list as JSON");
  command->add_option("--steps", options->steps, "derivation steps; else those the file says");
  command->add_option("--seed", options->seed, "seed of the random numbers")->capture_default_str();
  command->add_option("--set", options->assignments, "change a parameter: name=value (repeatable)")
      ->allow_extra_args(false);
  command
      ->add_option("--volume", options->volumes,
                   "NAME=VOLUME: instead of a volume that the file declares, in metres (repeatable); see "
                   "--prune-to of render")
      ->allow_extra_args(false);
  command->add_flag("--string", options->print_string, "print the string instead of drawing it");
  command->add_option("--frames", options->frames,
                      "a growth sequence: an animated GIF of this many pictures, or for -o NAME.png "
                      "NAME_000.png, NAME_001.png, …");
  command->add_option("--frame-seconds", options->frame_seconds, "how long a GIF shows each picture")
      ->capture_default_str();
  command->add_option("-o,--output", options->output, "the PNG to write; with --frames also a GIF");
  add_view_options(*command, options->view);
  command->add_flag("--ground", options->shading.ground,
                    "a lawn; needs an elevation above 0 or --perspective");
  command->add_option("--samples", options->shading.samples_per_px, "rays a pixel, 1 to 1024")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--max-modules", options->limits.modules, "longest string that may be derived")
      ->capture_default_str();
  command
      ->add_option("--max-lua", options->limits.lua_instructions,
                   "instructions that the file's Lua code may run")
      ->capture_default_str();
  command
      ->add_option("--max-work", options->limits.work,
                   "work of the derivation and its drawing, in units of about a nanosecond")
      ->capture_default_str();
  command->callback([options] { run_lsystem(*options); });
}

}  // namespace espalier
