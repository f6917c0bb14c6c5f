// The trials of a run: every point that its starts and searches evaluated, with what came of it. The log of a
// run holds values, no points; but the optimiser, served these values again, asks for the same points again,
// to the last bit. So a table of trials can be made of any run, also of an old one, and nothing is grown for
// it.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <espalier/core/parameter_table.h>
#include <espalier/fitting/record/fit_stages.h>

namespace espalier {

struct Trial {
  long evaluation = 0;  ///< counted from 1
  FitStage stage = FitStage::starts;
  double value = 0;   ///< of the objective, which is minimised
  float seconds = 0;  ///< since the run began, when its batch was done
  const ParameterValues& values;
};

/// In the order in which they were made; `begin` is told the table of the model first. The run may still go
/// on. Throws InputError where the directory holds no run or no evaluation, its pictures are gone, or its
/// points are not those that were evaluated: made with other presets or another program. pictures: where
/// those of the run are now, one a view; none: where the run finds them itself [run_pictures.h].
void replay_trials(const std::filesystem::path& run, const std::function<void(const ParameterTable&)>& begin,
                   const std::function<void(const Trial&)>& on_trial,
                   const std::vector<std::string>& pictures = {});

/// How many trials each stage has.
using TrialCounts = std::vector<std::pair<FitStage, long>>;

/// Writes them as CSV: evaluation, stage, value, seconds and the parameters by their names, choices as
/// numbers, all in the shortest decimals that read back to the same bits.
TrialCounts write_trials(const std::filesystem::path& run, const std::filesystem::path& csv,
                         const std::vector<std::string>& pictures = {});

}  // namespace espalier
