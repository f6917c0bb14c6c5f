#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <numeric>
#include <system_error>
#include <thread>

#include <espalier/core/files.h>
#include <espalier/experiments/declaration/target_files.h>
#include <espalier/experiments/posteriors/target_posteriors.h>
#include <espalier/experiments/runner/fit_runs.h>
#include <espalier/experiments/runner/growth_runs.h>
#include <espalier/experiments/runner/kept_targets.h>
#include <espalier/experiments/runner/move_runs.h>
#include <espalier/experiments/runner/picture_runs.h>
#include <espalier/experiments/runner/run_experiment.h>
#include <espalier/machine/directory_lock.h>
#include <espalier/machine/processors.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

/// What the threads share: the next run to take, how far each has come, and the rows.
class Runner {
 public:
  Runner(const fs::path& directory, const RunnerOptions& options, ExperimentOutcome& outcome)
      : directory_(directory),
        options_(options),
        outcome_(outcome),
        done_share_(outcome.rows.size()),
        done_before_(std::count_if(outcome.rows.begin(), outcome.rows.end(),
                                   [](const RunRow& row) { return row.status == "done"; })) {}

  /// Of one thread: takes runs until none is left.
  void work() {
    try {
      for (std::size_t index = next_++; index < outcome_.rows.size() && !is_stopped(); index = next_++)
        if (outcome_.rows[index].status == "left") run(index);
    } catch (...) {
      const std::lock_guard guard(mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
  }

  /// Throws what ended the runner itself: tables that could not be written.
  void check() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  bool is_stopped() {
    const std::lock_guard guard(mutex_);
    return failure_ || options_.stop_requested();
  }

  void run(std::size_t index) {
    RunRow row = outcome_.rows[index];
    const RunContext context{[this] { return is_stopped(); }, [&](double share) { report(index, share); }};
    const fs::path run = run_directory(directory_, row.run);
    try {
      if (const auto measured = outcome_.plan.runs[index].execute(run, context)) {
        write_finished(run, *measured);
        row.measured = *measured;
        row.status = "done";
      }
    } catch (const std::exception& error) {
      row.status = "failed";
      row.error = error.what();
    }
    finish(index, row);
  }

  void finish(std::size_t index, const RunRow& row) {
    const std::lock_guard guard(mutex_);
    outcome_.rows[index] = row;
    done_share_[index] = 1;
    write_tables(directory_, outcome_.plan, outcome_.rows);
    report_all();
  }

  void report(std::size_t index, double share) {
    const std::lock_guard guard(mutex_);
    done_share_[index] = share;
    report_all();
  }

  void report_all() const {
    ExperimentProgress progress{outcome_.rows.size(), 0, 0, {}};
    for (const RunRow& row : outcome_.rows)
      progress.done += row.status == "done", progress.failed += row.status == "failed";
    const double worked = std::accumulate(done_share_.begin(), done_share_.end(), 0.0);
    const double left = static_cast<double>(outcome_.rows.size() - done_before_) - worked;
    const double seconds = std::chrono::duration<double>(Clock::now() - began_).count();
    constexpr double kEnough = 0.5;  // of a run: less says nothing of the others
    if (worked > kEnough) progress.seconds_left = left * seconds / worked;
    options_.on_progress(progress);
  }

  const fs::path& directory_;
  const RunnerOptions& options_;
  ExperimentOutcome& outcome_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::vector<double> done_share_;  ///< of each run, in this execution
  std::size_t done_before_;
  Clock::time_point began_ = Clock::now();
};

std::vector<RunRow> begin_rows(const Plan& plan, const fs::path& directory) {
  std::vector<RunRow> rows;
  for (const PlannedRun& run : plan.runs) {
    rows.push_back({.run = run.name, .labels = run.labels});
    if (const auto measured = read_finished(run_directory(directory, run.name)))
      rows.back().measured = *measured, rows.back().status = "done";
  }
  return rows;
}

/// Names and labels alone: nothing is drawn.
Plan names_of_runs(const Experiment& experiment) {
  if (experiment.fits) return name_fits(*experiment.fits);
  return plan_of(experiment, {});
}

/// Runs of an experiment that has grown keep what they are, and take the names that they have now.
void declare(const fs::path& directory, const Experiment& experiment) {
  if (const auto earlier = earlier_experiment(directory, experiment))
    move_runs(directory, renamed_runs(names_of_runs(*earlier), names_of_runs(experiment)),
              experiment.words.text);
  write_declaration(directory, experiment);
}

/// The names of the targets' directories, which differ as their names do.
std::vector<PosteriorTarget> posterior_targets(const FitsDeclaration& fits, const fs::path& directory) {
  std::vector<PosteriorTarget> targets;
  for (const ReadyTarget& target : keep_targets(fits, directory)) {
    PosteriorTarget& next = targets.emplace_back();
    next.name = target.declaration.name;
    next.directory = directory_name(next.name);
    next.picture = target.views.front().file();
    next.height_m = target.height_m.value_or(fits.record.height_m.value_or(next.height_m));
    if (!target.declaration.species.empty())
      next.truth = TrueTree{target.declaration.species, target.declaration.seed};
  }
  return targets;
}

/// "0.2.0 1a2b3c", as far as the record knows it.
std::string version_of(const FitRecord& record) {
  std::string version;
  for (const char* part : {"espalier", "commit"})
    if (const auto found = record.versions.find(part); found != record.versions.end())
      version += (version.empty() ? "" : " ") + found->second;
  return version;
}

void compute_posteriors(const FitsDeclaration& fits, const fs::path& directory, const RunnerOptions& options,
                        std::size_t runs) {
  const auto on_progress = [&](const std::string& target, std::size_t done, std::size_t wanted) {
    ExperimentProgress progress{.runs = runs, .done = runs, .seconds_left = {}};
    progress.posterior = fmt::format("posterior of {}: {} of {} plants", target, done, wanted);
    options.on_progress(progress);
    return !options.stop_requested();
  };
  write_target_posteriors(directory, posterior_targets(fits, directory),
                          {.reading = fits.record.target,
                           .simulations = static_cast<std::size_t>(fits.posterior_simulations),
                           .version = version_of(fits.record),
                           .on_progress = on_progress});
}

int job_count(const Plan& plan, const RunnerOptions& options) {
  if (plan.one_at_a_time) return 1;
  const int jobs = options.jobs > 0 ? options.jobs : processors() / plan.threads_per_run;
  return std::clamp(jobs, 1, static_cast<int>(std::max<std::size_t>(1, plan.runs.size())));
}

}  // namespace

Plan plan_of(const Experiment& experiment, const fs::path& directory) {
  if (experiment.fits) return plan_fits(*experiment.fits, directory);
  if (experiment.pictures) return plan_pictures(*experiment.pictures);
  return plan_growth(*experiment.growth);
}

ExperimentOutcome run_experiment(const Experiment& experiment, const fs::path& directory,
                                 const RunnerOptions& options) {
  check_experiment_directory(directory, experiment);
  make_directory(directory);
  const DirectoryLock lock(directory);
  finish_moves(directory);
  check_experiment_directory(directory, experiment);  // another process may have been quicker
  declare(directory, experiment);
  ExperimentOutcome outcome;
  outcome.plan = plan_of(experiment, directory);
  outcome.rows = begin_rows(outcome.plan, directory);
  write_tables(directory, outcome.plan, outcome.rows);  // of runs that were moved
  Runner runner(directory, options, outcome);
  const int jobs = job_count(outcome.plan, options);
  std::vector<std::jthread> others;
  try {
    for (int i = 1; i < jobs; ++i) others.emplace_back([&] { runner.work(); });
  } catch (const std::system_error&) {  // a limit on processes: those that there are do the work
  }
  runner.work();
  others.clear();
  runner.check();
  write_tables(directory, outcome.plan, outcome.rows);
  if (experiment.fits && experiment.fits->posterior && !options.stop_requested())
    compute_posteriors(*experiment.fits, directory, options, outcome.rows.size());
  return outcome;
}

}  // namespace espalier
