// The program: its subcommands, and the one place where errors become messages and exit codes.
#include <fmt/core.h>
#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <espalier/app/commands/commands.h>
#include <espalier/app/help_format.h>
#include <espalier/app/main/examples.h>
#include <espalier/app/main/old_names.h>
#include <espalier/app/main/program.h>
#include <espalier/app/main/wrong_words.h>
#include <espalier/app/options/messages.h>
#include <espalier/app/options/option_names.h>
#include <espalier/app/options/plain_numbers.h>
#include <espalier/app/version.h>
#include <espalier/core/field_error.h>
#include <espalier/machine/processors.h>

namespace espalier {

namespace {

/// Commands, in the order of the help.
void add_commands(CLI::App& app) {
  for (const auto& [group, commands] : std::vector<std::pair<const char*, std::vector<void (*)(CLI::App&)>>>{
           {"Fit trees to pictures",
            {add_fit_command, add_posterior_command, add_trials_command, add_target_command,
             add_compare_command}},
           {"Look at trees",
            {add_species_command, add_lsystem_command, add_render_command, add_mesh_command, add_mask_command,
             add_params_command}},
           {"Between species", {add_space_command, add_blend_command}},
           {"Study methods", {add_experiment_command, add_bench_command}},
           {"About the program", {add_reference_command, add_completion_command}}})
    for (const auto& add : commands) {
      add(app);
      app.get_subcommands({}).back()->group(group);
    }
}

/// CLI11 takes words from the back.
std::vector<std::string> reversed(std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());
  return words;
}

/// Help and the version are no errors; words that lead nowhere are.
int print_parsing(const CLI::App& app, const std::vector<std::string>& words, const CLI::ParseError& error) {
  if (ends_before_command(app, words)) {
    fmt::print("{}", app.help());
    return 0;
  }
  print_message(explain_wrong_words(app, words, error));
  return 2;
}

/// What the input or the machine refuses exits 2, a failure of ours 1.
int print_failure(const std::exception& error) {
  if (const auto* field = dynamic_cast<const FieldError*>(&error))
    print_message(fmt::format("{}: {}", option_of(field->field), field->complaint));
  else if (dynamic_cast<const InputError*>(&error))
    print_message(error.what());
  else if (dynamic_cast<const std::bad_alloc*>(&error))
    print_message("got too little memory, expected more of it or a smaller input");
  else if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    print_message(fmt::format("{}: got '{}', expected what can be read and written", file->path1().string(),
                              file->code().message()));
  else {
    print_message(fmt::format("internal error: {}", error.what()));
    return 1;
  }
  return 2;
}

int run_words(CLI::App& app, const std::vector<std::string>& words) {
  try {
    app.parse(reversed(words));
    return 0;
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::RuntimeError& ended) {
    return ended.get_exit_code();  // a command that has said why
  } catch (const CLI::ParseError& error) {
    return print_parsing(app, words, error);
  } catch (const std::system_error& error) {
    if (!flush_output()) return 1;  // fmt throws where a stream is full
    return print_failure(error);
  } catch (const std::exception& error) {
    return print_failure(error);
  }
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  open_closed_streams();
  CLI::App app{"Espalier fits tree models to pictures.", "espalier"};
  app.require_subcommand(1);
  app.formatter(std::make_shared<HelpFormat>());
  app.set_version_flag("--version", version_text, "Print the version, the commit and the libraries");
  add_commands(app);
  demand_plain_numbers(app);
  add_examples(app);
  if (processors() < runnable_processors())
    omp_set_num_threads(std::min(omp_get_max_threads(), processors()));
  const int code = run_words(app, with_names_of_today({argv + std::min(argc, 1), argv + argc}));
  const bool is_printed = flush_output();
  return code == 0 && !is_printed ? 1 : code;
}

}  // namespace espalier
