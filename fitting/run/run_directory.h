// The directory a run leaves: every file is replaced whole, so a run killed at any moment leaves a valid
// one. run.toml and evaluations.bin repeat or resume it; plots read the other files only.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <espalier/fitting/branches/branch_rounds.h>
#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/run/full_size.h>
#include <espalier/fitting/run/plant_portrait.h>
#include <espalier/fitting/run/run_files.h>
#include <espalier/fitting/search/logged_scorer.h>
#include <espalier/fitting/search/solution_archive.h>
#include <espalier/fitting/search/trace.h>
#include <espalier/fitting/species_space/resemblance.h>
#include <espalier/fitting/task/fit_task.h>
#include <espalier/fitting/task/plant_scorer.h>

namespace espalier {

/// A start point and how it scored.
struct ScoredStart {
  std::string name;
  double fitness = 0;
};

/// All that the files of a run are made from.
struct RunState {
  const FitRecord& record;
  const FitTask& task;
  std::vector<ScoredStart> starts = {};
  BestCandidate best = {};
  MaskMetrics best_metrics = {};
  Trace trace = {};
  BranchRounds branches = {};                         ///< of the refinement; no copies before it begins
  KindChoice kind = KindChoice::any;                  ///< of the tree, as it was read off the picture
  std::optional<MaskMetrics> metrics_untrained = {};  ///< of the same tree grown without the envelope
  std::optional<FullSize> full_size = {};             ///< once branches are refined
  long evaluations = 0;
  double seconds = 0;
  std::optional<FitStop> stopped_by = {};  ///< none while it runs
  std::size_t embree_disagreement_px = 0;
  CandidateFailures failures = {};              ///< since the run began or was resumed
  std::optional<SolutionArchive> archive = {};  ///< of the search of the parameters, once it begins
  std::optional<PlantPortrait> portrait = {};   ///< of the best plant, once the run ends
  std::optional<Picture> sheet = {};            ///< likewise
  std::vector<Resemblance> resemblances = {};   ///< likewise
};

/// What the branches of the best tree are overridden by.
const Overrides& best_overrides(const RunState& state);

/// The seed of the best tree; of several that are averaged, the first.
Seed best_seed(const RunState& state);

/// The refinement that a run in the directory had reached; none where it had not begun.
std::optional<BranchRounds> read_branch_rounds(const std::filesystem::path& directory,
                                               const ParameterTable& table);

/// Throws InputError unless `directory` is missing or empty, and not a file. What a process that was killed
/// in its first moments left does not count.
void check_new_directory(const std::filesystem::path& directory);

/// Throws InputError unless it holds a run that can go on. Nothing in it may be a link: files of the run are
/// replaced, and a stranger's run must not replace others.
void check_run_directory(const std::filesystem::path& directory);

/// Takes away what is not sound of a run that is to go on, while nobody else works in it: what killed
/// processes left, and a state of the refinement that is damaged or that the log does not reach, without
/// which the run makes it anew. Returns what was not sound, in words.
std::vector<std::string> mend_run_directory(const std::filesystem::path& directory,
                                            const ParameterTable& table);

/// Writes the pictures, the files, run.toml and the target masks. Throws InputError where it cannot.
void begin_run_directory(const std::filesystem::path& directory, const RunState& state,
                         const std::vector<RunFile>& files);

/// Draws the best candidate, counts where Embree disagrees, and replaces all files but the log.
void write_run_directory(const std::filesystem::path& directory, RunState& state);

}  // namespace espalier
