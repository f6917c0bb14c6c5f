// The command-line options that say how a picture becomes a target mask; shared by all commands that read
// one.
#pragma once
#include <memory>

#include <espalier/image/reading/read_target.h>

namespace CLI {
class App;
}

namespace espalier {

/// Adds those of the options of a fit that say how its picture is read, by the same names; they are filled in
/// when `command` is parsed. A name that the command has already, such as --frame of `compare`, stays its
/// own.
std::shared_ptr<TargetOptions> add_target_options(CLI::App& command);

}  // namespace espalier
