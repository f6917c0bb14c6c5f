// A fit that runs: its state, its clock, and when it stops. Its stages are in files of their own:
// fit_run_search.cpp scores starts and searches parameters, fit_run_refinement.cpp refines branches.
#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <espalier/fitting/record/search_space.h>
#include <espalier/fitting/run/fit.h>
#include <espalier/fitting/run/run_directory.h>
#include <espalier/fitting/search/logged_scorer.h>
#include <espalier/fitting/search/space_search.h>
#include <espalier/fitting/starts/fit_plan.h>
#include <espalier/fitting/task/plant_scorer.h>
#include <espalier/fitting/task/sized_tasks.h>

namespace espalier {

/// The optimiser never sees the limit (LoggedScorer keeps it), so that it does the same for every limit.
inline constexpr long kUnlimited = 1'000'000'000;

/// The refinement that a run to be resumed had begun, unless its search is now to go further.
std::optional<BranchRounds> reached_rounds(const FitRecord& record, const FitTask& task,
                                           const std::filesystem::path& directory,
                                           const FitExecution& options);

/// The one that the caller brought along, or the record's by name.
const Optimizer& optimizer_of(const FitRecord& record, const FitExecution& options);

/// At least 1: as many as asked for, or one for each processor.
int threads_of(const FitExecution& options);

/// The species space that the run searches first, if it does.
std::optional<SpeciesSpace> space_of(const FitRecord& record, const Model& model);

/// A log to be gone through again: nothing is evaluated or written.
struct Replay {
  std::vector<LoggedEvaluation> logged;
  std::function<void(FitStage, const ScoredBatch&)> on_batch = {};  ///< none: it is no replay, but a run
};

/// One run: its state, its clock, and when it stops.
class FitRun : public Observer {
 public:
  FitRun(const FitRecord& record, const FitTask& task, const FitPlan& plan,
         const std::filesystem::path& directory, const FitExecution& options, Replay replay = {});

  FitResult run(const std::optional<SpeciesSpace>& species);
  /// Starts and searches as they were logged. Throws InputError where they are not those of the log.
  void replay(const std::optional<SpeciesSpace>& species);
  bool stop_requested() override;

 private:
  using Clock = std::chrono::steady_clock;

  double seconds() const;
  void refresh_directory();
  void refresh_directory_if_old();
  void report_progress() const;
  MaskMetrics untrained_metrics();
  FitResult finish();

  // fit_run_search.cpp
  void on_scored(const ScoredBatch& batch);
  void search_from_starts(const std::optional<SpeciesSpace>& species);
  std::vector<double> score_starts(const std::vector<StartPoint>& starts);
  void search_species(const SpeciesSpace& species, std::vector<StartPoint>& starts,
                      std::vector<double>& scores);
  MinimizeResult minimize(const Objective& objective, long evaluations, std::span<const double> points);
  void search(const std::vector<StartPoint>& starts, const std::vector<double>& scores);
  void begin_from_best(const std::vector<StartPoint>& starts, const std::vector<double>& scores);
  bool search_time_is_over() const;
  void warn_over_budget(const std::string& start, double factor) const;
  void portray_best();

  // fit_run_refinement.cpp
  bool will_refine() const;
  bool is_traced() const;  ///< branches come from the picture
  bool finishes_at_full_size() const;
  void refine();
  std::vector<Solution> refinement_starts();
  void go_on_from(const BranchRounds& reached);
  void refine_by_rounds();
  void begin_finish();
  bool finishing() const { return state_.branches.finish_from >= 0; }
  void note_round();
  void add_to_trace(const RoundRow& row);

  const FitRecord& record_;
  int threads_;
  const FitTask& task_;
  const FitPlan& plan_;
  SizedTasks sized_tasks_;
  std::filesystem::path directory_;
  const FitExecution& options_;
  RunState state_;
  Replay replay_;
  EvaluationLog log_;
  PlantScorer plant_scorer_;
  LoggedScorer scorer_;
  std::unique_ptr<SilhouetteRenderer> renderer_;
  std::optional<FitTask> finer_task_;  ///< once the finish begins
  Overrides given_overrides_;          ///< of the tree that the refinement starts from
  std::size_t dimension_ = 0;
  FitStage stage_ = FitStage::starts;
  double seconds_before_ = 0;  ///< of the run up to live_since_
  Clock::time_point live_since_ = Clock::now();
  double refreshed_at_ = 0, refresh_cost_ = 0;
};

}  // namespace espalier
