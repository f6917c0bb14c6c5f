// The program as a function.
#pragma once

namespace espalier {

/// Parses the arguments, runs the command, prints errors. Returns the exit code: 0, 1 (our failure), 2 (bad
/// input).
int run_program(int argc, const char* const* argv);

}  // namespace espalier
