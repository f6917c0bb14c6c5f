// What a run says of itself in summary.json. A new field is a line in run_summary.
#pragma once
#include <string>

#include <espalier/fitting/run/run_directory.h>

namespace espalier {

/// The text of summary.json.
std::string run_summary(const RunState& state);

}  // namespace espalier
