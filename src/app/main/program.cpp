// The program: its subcommands, and the one place where errors become messages and exit codes.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include <espalier/app/commands/commands.h>
#include <espalier/app/main/program.h>
#include <espalier/app/options/option_names.h>
#include <espalier/app/version.h>
#include <espalier/core/field_error.h>

namespace espalier {

namespace {

/// One line whatever the message holds, so that scripts can read it.
void print_error(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  fmt::print(stderr, "espalier: {}\n", message);
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  CLI::App app{"Espalier fits tree models to pictures.", "espalier"};
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text, "Print the version, the commit and the libraries");
  // Commands, in the order of the help.
  add_fit_command(app);
  add_trials_command(app);
  add_target_command(app);
  add_compare_command(app);
  add_mask_command(app);
  add_render_command(app);
  add_mesh_command(app);
  add_bench_command(app);
  add_experiment_command(app);
  add_species_command(app);
  add_lsystem_command(app);
  add_space_command(app);
  add_blend_command(app);
  add_posterior_command(app);
  add_params_command(app);
  add_reference_command(app);
  add_completion_command(app);
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::RuntimeError& ended) {
    return ended.get_exit_code();  // a command that has said why
  } catch (const CLI::ParseError& error) {
    print_error(fmt::format("{} (try: espalier --help)", error.what()));
    return 2;
  } catch (const FieldError& error) {
    print_error(fmt::format("{}: {}", option_of(error.field), error.complaint));
    return 2;
  } catch (const InputError& error) {
    print_error(error.what());
    return 2;
  } catch (const std::exception& error) {
    print_error(fmt::format("internal error: {}", error.what()));
    return 1;
  }
}

}  // namespace espalier
