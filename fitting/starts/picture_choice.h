// What a picture says of the search for its tree: which parameters it holds fixed or in ranges, and where it
// starts. "auto" reads the picture (fitting/picture/picture_reading.h); what the user frees or fixes himself
// is left to him.
#pragma once
#include <string>

#include <espalier/fitting/starts/start_points.h>
#include <espalier/fitting/task/fit_record.h>
#include <espalier/fitting/task/fit_task.h>

namespace espalier {

/// The record's kind of tree; where it is automatic, that of the first picture.
KindChoice kind_of(const FitRecord& record, const FitTask& task);

/// The record's choice, and what its kind adds, unless that is any: no leaves on a leafless tree, plausible
/// ranges (fitting/starts/measured_start.h), one trunk where the picture shows one foot.
SearchChoice choice_for(const FitRecord& record, const FitTask& task);

/// The record's starts, of a palm those with fronds, thinned, as tall as the target, and, unless the kind is
/// any, to the measure of the picture. Presets that are named are taken as they are written where nothing
/// is searched.
std::vector<StartPoint> starts_for(const FitRecord& record, const FitTask& task);

/// Gives all candidates of a palm a trunk that lies on the picture's (fitting/branches/palm_trunk.h): the
/// choice fixes its parameters, the task gets its overrides. Other kinds of trees are left as they are.
void hold_trunk(const FitRecord& record, FitTask& task);

/// Of the time, where refinement follows for as long as it lasts: less where the branches are seen and
/// traced.
double search_share(KindChoice kind);

}  // namespace espalier
