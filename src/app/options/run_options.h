// Options of commands that read a run again.
#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace espalier {

/// Adds --picture: where the pictures of a run are now.
CLI::Option* add_picture_option(CLI::App& command, std::vector<std::string>& pictures);

}  // namespace espalier
