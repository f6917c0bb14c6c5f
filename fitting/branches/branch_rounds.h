// Stages (d) and (e) of a fit, round by round: branches of several orders are refined in turn, low orders
// most often, on several copies of the tree at once, each with its own draws; the best is the result.
// A round is a pure function of the state before it, so a run that is stopped after any of them goes on with
// the same bits, for any number of threads.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include <espalier/fitting/branches/solution.h>
#include <espalier/fitting/record/fit_stages.h>
#include <espalier/fitting/task/fit_task.h>

namespace espalier {

/// The best tree after a round, for the trace.
struct RoundRow {
  FitStage stage = FitStage::branches;  ///< or tracing, finish
  long steps = 0;
  double seconds = 0;
  double score = 1;  ///< in masks of the search's size, as all stages before
  double own_score =
      1;  ///< that the stage refines by: in the finish the mean over both sizes; with its price
  MaskMetrics metrics;
};

struct BranchRounds {
  std::vector<Solution> copies;
  long rounds = 0;
  long finish_from = -1;          ///< round before which the finish began; -1: it has not
  long steps = 0;                 ///< branches grown, drawn and scored, over all copies
  long search_evaluations = 0;    ///< of the search before them
  long search_limit = 0;          ///< that it was given: a search with another limit has another end
  std::vector<RoundRow> history;  ///< the first row is the state before the first round

  const Solution& best() const;
};

/// The copies as another task scores them: one that looks at its pictures in another way.
void rescore(const FitTask& task, BranchRounds& state);

/// Copies that begin with the starts in turn.
BranchRounds begin_branch_rounds(const FitTask& task, const std::vector<Solution>& starts,
                                 long search_evaluations);

/// Makes one round on all copies; after each round of all orders, all go on from the best.
void refine_round(const FitTask& task, Seed seed, int threads, BranchRounds& state);

/// As files hold it: values without the rows that a plant of the model's defaults does not use, where the
/// copies do not use them either. So files of versions before those rows are as they would be now.
BranchRounds stored(BranchRounds state, const ParameterTable& table);
/// The inverse: what is not stored is the model's default.
void restore(const ParameterTable& table, BranchRounds& state);

/// The state as text, and back; `table` is the model's. Throws InputError naming `source` where the text is
/// no such state.
std::string branch_rounds_to_json(const BranchRounds& state, const std::string& model);
BranchRounds branch_rounds_from_json(const std::string& text, const ParameterTable& table,
                                     const std::string& source);

}  // namespace espalier
