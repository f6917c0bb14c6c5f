// Runs of the kind [fits]: each is a run of espalier fit in its own directory, then its result is grown with
// seeds that the fit never saw.
#pragma once
#include <espalier/experiments/declaration/experiment.h>
#include <espalier/experiments/runner/plan.h>

namespace espalier {

/// Targets that are species are drawn into `directory`/targets. Throws InputError where that fails.
Plan plan_fits(const FitsDeclaration& fits, const std::filesystem::path& directory);

/// The same runs by name, with nothing drawn; they cannot be executed.
Plan name_fits(const FitsDeclaration& fits);

}  // namespace espalier
