// What a picture says of the search for its tree: which parameters it holds fixed. "auto" reads the picture
// (fitting/stages/picture_reading.h); what the user frees or fixes himself is left to him.
#pragma once
#include <string>

#include "fitting/fit_record.h"
#include "fitting/fit_task.h"

namespace espalier {

/// The record's kind of tree; where it is "auto", that of the first picture.
std::string kind_of(const FitRecord& record, const FitTask& task);

/// The record's choice, and what its kind adds: no leaves on a leafless tree; one trunk where the picture,
/// read by "auto", shows one foot.
SearchChoice choice_for(const FitRecord& record, const FitTask& task);

}  // namespace espalier
