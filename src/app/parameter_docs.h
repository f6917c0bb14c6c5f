// The parameter table of a model as something to read: text for a terminal, Markdown for
// docs/parameters.md, JSON for programs.
#pragma once
#include <string>

#include <espalier/core/parameter_table.h>

namespace espalier {

std::string parameters_as_text(const ParameterTable& table);
std::string parameters_as_markdown(const ParameterTable& table);

/// {"model": …, "parameters": [{"name": "curve_v", "level": 2, …}, …]}, one object a row of the table.
std::string parameters_as_json(const ParameterTable& table);

}  // namespace espalier
