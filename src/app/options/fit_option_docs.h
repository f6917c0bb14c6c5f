// The table of a fit's options as Markdown, for docs/fit_options.md.
#pragma once
#include <string>

namespace espalier {

std::string fit_options_as_markdown();

}  // namespace espalier
