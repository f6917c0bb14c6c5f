// What is wrong with a command line that does not parse, as one line: which word, what was expected there,
// and what may have been meant.
#pragma once
#include <span>
#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace espalier {

/// `words` without the name of the program; `error` is what CLI11 said of them.
std::string explain_wrong_words(const CLI::App& app, std::span<const std::string> words,
                                const CLI::ParseError& error);

/// Whether the words name nothing but a command that has commands of its own, or none at all: who asks so
/// wants to know which there are.
bool ends_before_command(const CLI::App& app, std::span<const std::string> words);

}  // namespace espalier
