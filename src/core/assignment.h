// name=value, as the command line gives parameters and settings: one way for all commands and options. A
// value is a decimal number or, where a parameter has choices, the name of one.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include <espalier/core/parameter_table.h>

namespace espalier {

struct Assignment {
  std::string name, value;
};

/// Splits at the first '='. Throws InputError where there is none, or no name before it.
Assignment parse_assignment(const std::string& text);

/// A finite number in decimal digits: "3", "-.5", "1e-3". Nothing for other texts, such as "0x3" and "nan".
std::optional<double> parse_decimal(std::string_view text);

/// A number, or the name of one of the row's choices; inside of its bounds. Throws InputError.
double parse_parameter_value(const ParameterInfo& row, const std::string& text);

}  // namespace espalier
