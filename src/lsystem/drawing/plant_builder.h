// From a string to a plant. Consecutive segments of an axis become one smooth stem, a cubic Bézier spline
// with a radius at each knot [CH §3.1.2]; a branch without segments leaves no trace. Metres, z up.
// Plants know leaves of one outline: where a string has filled polygons, these and all leaves are drawn as
// triangles, each a leaf of the triangular outline.
#pragma once
#include <vector>

#include <espalier/lsystem/notation/settings.h>
#include <espalier/lsystem/strings/module_string.h>
#include <espalier/lsystem/strings/work.h>
#include <espalier/plant/joints.h>

namespace espalier::lsystem {

/// Draws a string (after interpretation) into `plant`, whose memory is reused; `joints`, unless null, gets
/// where its parts are fixed.
/// Throws InputError for polygons that are not closed or commands with wrong parameters, TooMuchWork.
void build_plant(const ModuleString& string, const SymbolTable& alphabet, const Settings& settings,
                 Plant& plant, Work& work, PlantJoints* joints = nullptr);
/// The same with work of its own, as much as Limits says.
void build_plant(const ModuleString& string, const SymbolTable& alphabet, const Settings& settings,
                 Plant& plant, PlantJoints* joints = nullptr);

}  // namespace espalier::lsystem
