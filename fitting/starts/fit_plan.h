// What is settled before a fit begins, once and in one place: the kind of tree, what is searched and in which
// ranges, where the search starts, which overrides all candidates bear, how free single
// branches are, and how the time is shared out. The picture has been read by then (TargetView::reading). What
// the user frees or fixes is left to the user.
#pragma once
#include <string>
#include <vector>

#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/starts/start_points.h>
#include <espalier/fitting/task/fit_task.h>

namespace espalier {

/// How a run's time is shared out among its stages.
struct StageShares {
  double search = 0;         ///< of the whole, where refinement follows for as long as time lasts
  double before_finish = 0;  ///< of the rounds, or the time, that the refinement gets
};

StageShares shares_of(KindChoice kind);

/// Where nobody says it: the picture of a leafless tree or a palm shows its branches, that of a crown does
/// not.
double usual_freedom(KindChoice kind);

struct FitPlan {
  KindChoice kind = KindChoice::any;  ///< the record's; where that is automatic, the first picture's
  /// The record's choice and what the kind adds to it, unless that is any: no leaves on a leafless tree,
  /// plausible ranges (measured_start.h), one trunk where the picture shows one foot. Where a
  /// species is named, what that allows (species_range.h).
  SearchChoice choice;
  /// The record's starts, of a palm those with fronds: thinned, as tall as the target, and to the measure of
  /// the picture. Where the choice fixes that they use a crown envelope, and they had none, it is the
  /// picture's, but for what else is fixed. Presets that are named are as they are written where nothing is
  /// searched.
  std::vector<StartPoint> starts;
  /// Of all candidates: the trunk of a palm, which lies on the picture's (branches/palm_trunk.h).
  Overrides held;
  StageShares shares;
  double freedom = kWholeFreedom;  ///< of single branches: the record's, or what the kind needs
};

/// Throws InputError where a start, or the species, is no preset of the model.
FitPlan plan_of(const FitRecord& record, const FitTask& task);

/// Gives the task what the plan says of branches: the overrides that all candidates hold, and their freedom.
void settle_branches(const FitPlan& plan, FitTask& task);

}  // namespace espalier
