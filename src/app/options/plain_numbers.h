// Numbers of the command line as people write them. CLI11 reads them as C does: 0x10 is 16, 010 is 8, -1 the
// largest seed there is, and what is beyond a type its last value.
#pragma once

namespace CLI {
class App;
}

namespace espalier {

/// Has all options of the program that take a number refuse what is no finite decimal number within its type,
/// in the words "got '0x10', expected a whole number". Words, which some options take instead, are left to
/// these.
void demand_plain_numbers(CLI::App& app);

}  // namespace espalier
