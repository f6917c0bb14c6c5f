// Three examples of each command, for its help.
#pragma once

namespace CLI {
class App;
}

namespace espalier {

/// Puts them below the help of every command, before what that says at its end.
void add_examples(CLI::App& app);

}  // namespace espalier
