// The subcommands of the program, one file each (command_<name>.cpp).
// A command adds itself to the CLI::App and does its work in the subcommand's callback.
#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace espalier {

void add_fit_command(CLI::App& app);
void add_trials_command(CLI::App& app);
void add_target_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_mask_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_mesh_command(CLI::App& app);
void add_bench_command(CLI::App& app);
void add_experiment_command(CLI::App& app);
void add_species_command(CLI::App& app);
void add_lsystem_command(CLI::App& app);
void add_space_command(CLI::App& app);
void add_blend_command(CLI::App& app);
void add_posterior_command(CLI::App& app);
void add_params_command(CLI::App& app);
void add_reference_command(CLI::App& app);
void add_completion_command(CLI::App& app);

/// The tables that `espalier reference` prints.
std::vector<std::string> reference_topics();

}  // namespace espalier
