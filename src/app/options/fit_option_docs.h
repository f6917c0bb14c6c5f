// The table of a fit's options as something to read: text for a terminal, Markdown for docs/fit_options.md,
// JSON for programs.
#pragma once
#include <string>

namespace espalier {

std::string fit_options_as_text();
std::string fit_options_as_markdown();

/// {"options": [{"option": "--kind", "key": "kind", …}, …]}, one object a row of the table.
std::string fit_options_as_json();

}  // namespace espalier
