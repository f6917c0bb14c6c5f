// The help of commands: options in groups, a word for what each takes, at most 100 columns, examples at the
// end.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace espalier {

inline constexpr std::size_t kHelpColumns = 100;

class HelpFormat : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* command, std::string name, CLI::AppFormatMode mode) const override;
};

/// The text in lines of at most 100 columns, where no word is longer: the first behind `head`, or below it
/// where that is long, the others `indent` columns in.
std::string in_columns(const std::string& head, const std::string& text, std::size_t indent);

}  // namespace espalier
