// Runs that have other names in a grown experiment: a name holds what varies, and a sheet's its place. Their
// directories are moved by a journal, move_runs.json, so that a process killed at any moment leaves what the
// next one finishes.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <espalier/experiments/runner/plan.h>

namespace espalier {

struct RunMove {
  std::string from, to;  ///< names of run directories
};

/// The runs of `was` that `is` calls otherwise; runs are the same where their labels are.
std::vector<RunMove> renamed_runs(const Plan& was, const Plan& is);

/// Moves those directories that are there, in any order of names, circles too; then experiment.toml says
/// `declaration`. `after_step` is for tests, which stop it there. Throws InputError where the system refuses.
void move_runs(
    const std::filesystem::path& directory, const std::vector<RunMove>& moves, const std::string& declaration,
    const std::function<void()>& after_step = [] {});

/// Finishes what a killed process began, if there is something.
void finish_moves(
    const std::filesystem::path& directory, const std::function<void()>& after_step = [] {});

}  // namespace espalier
