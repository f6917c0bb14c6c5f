#include <fmt/format.h>

#include <iterator>
#include <string>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/fitting/run/fit_run.h>
#include <espalier/fitting/run/run_pictures.h>
#include <espalier/fitting/run/trials.h>
#include <espalier/fitting/task/record_task.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

std::vector<LoggedEvaluation> logged_in(const fs::path& run) {
  check_run_directory(run);
  const fs::path file = run / "evaluations.bin";
  LogContent log = read_evaluation_log(file);
  if (log.is_damaged)
    throw_input_error("{}: evaluation {} is damaged, expected a sound log: the run mends it where it goes on",
                      file.string(), log.evaluations.size() + 1);
  if (log.evaluations.empty())
    throw_input_error("{}: got no evaluations, expected a run that has made some", file.string());
  return std::move(log.evaluations);
}

std::string head_of(const ParameterTable& table) {
  std::string line = "evaluation,stage,value,seconds";
  for (const ParameterInfo& row : table.rows) line.append(",").append(row.full_name());
  return line.append("\n");
}

std::string line_of(const Trial& trial) {
  std::string line =
      fmt::format("{},{},{},{}", trial.evaluation, name_of(trial.stage), trial.value, trial.seconds);
  for (const double value : trial.values) fmt::format_to(std::back_inserter(line), ",{}", value);
  return line + "\n";
}

void count_trial(FitStage stage, TrialCounts& counts) {
  if (counts.empty() || counts.back().first != stage) counts.emplace_back(stage, 0);
  ++counts.back().second;
}

}  // namespace

void replay_trials(const fs::path& run, const std::function<void(const ParameterTable&)>& begin,
                   const std::function<void(const Trial&)>& on_trial,
                   const std::vector<std::string>& pictures) {
  const std::vector<LoggedEvaluation> logged = logged_in(run);
  FitRecord record = read_record(run / "run.toml").record;
  find_pictures(record, run, pictures);
  record.budget.target_fitness = 0;  // a log may go on beyond what a resumed run was told to stop at
  FitTask task = make_task(record, nullptr);
  const FitExecution execution{};
  task.make_renderer = execution.make_renderer;
  const FitPlan plan = plan_of(record, task);
  settle_branches(plan, task);
  begin(task.model->table());
  const auto on_batch = [&](FitStage stage, const ScoredBatch& batch) {
    for (std::size_t i = 0; i < batch.scores.size(); ++i) {
      const std::size_t index = static_cast<std::size_t>(batch.first_evaluation) + i;
      on_trial(
          {static_cast<long>(index) + 1, stage, batch.scores[i], logged[index].seconds, batch.candidates[i]});
    }
  };
  FitRun(record, task, plan, run, execution, {logged, on_batch}).replay(space_of(record, *task.model));
}

TrialCounts write_trials(const fs::path& run, const fs::path& csv, const std::vector<std::string>& pictures) {
  TrialCounts counts;
  write_file_atomically(csv, [&](const TakeBytes& take) {
    replay_trials(
        run, [&](const ParameterTable& table) { take(head_of(table)); },
        [&](const Trial& trial) {
          take(line_of(trial));
          count_trial(trial.stage, counts);
        },
        pictures);
  });
  return counts;
}

}  // namespace espalier
