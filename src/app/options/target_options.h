// The command-line options that say how a picture becomes a target mask; shared by all commands that read
// one.
#pragma once
#include <memory>

#include <espalier/image/reading/read_target.h>

namespace CLI {
class App;
}

namespace espalier {

/// Adds --separation, --tree-side, --speck and --fill-pinholes; the options are filled in when `command` is
/// parsed.
std::shared_ptr<TargetOptions> add_target_options(CLI::App& command);

}  // namespace espalier
