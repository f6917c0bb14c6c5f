// Stage 2 of a fit, of palms: the trunk lies on its line from the start, so that the search is of the crown
// alone: its parameters are those of a plain trunk, and overrides bend and lean it. Which parameters these
// are the model's table says by roles (core/parameter_role.h).
#pragma once
#include <map>
#include <string>

#include <espalier/fitting/picture/trunk_line.h>
#include <espalier/fitting/task/fit_task.h>

namespace espalier {

/// Whether trunks of the model can be held to a line: it says how long and how thick they are, in metres, and
/// follows overrides.
bool can_hold_trunks(const Model& model);

/// A palm: one trunk of this length and taper, straight but for its overrides, and fronds on it. By full
/// names of parameters of `table`.
std::map<std::string, double> palm_parameters(const ParameterTable& table, const TrunkLine& line,
                                              double metres_per_px);

/// The overrides of trunk 0 with which a tree of these values stands on the line, in the picture's plane.
Overrides lay_palm_trunk(const FitTask& task, const TrunkLine& line, const ParameterValues& values);

}  // namespace espalier
