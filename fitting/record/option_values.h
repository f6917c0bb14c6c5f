// Values of the options of a fit on their way between a record, the words of a command line, and TOML. All
// that set one throw FieldError with the row's field: got, expected.
#pragma once
#include <string>
#include <vector>

#include <espalier/core/toml/toml_section.h>
#include <espalier/fitting/record/fit_options.h>

namespace espalier {

enum class ValueType { flag, whole, number, text, texts, assignments, views };

ValueType type_of(const FitOption& option);

OptionValue get_value(const FitOption& option, const FitRecord& record);

/// Checks type and range, but not what takes the rest of the record.
void set_value(const FitOption& option, const OptionValue& value, FitRecord& record);

/// The words of a user: one, or a few of lists.
void set_from_words(const FitOption& option, const std::vector<std::string>& words, FitRecord& record);

/// A key of a file: of a record, or of what a user asks for, who asks for no zero where that says "none".
void set_from_record(const FitOption& option, const toml::node& node, const std::string& source,
                     FitRecord& record);
void set_from_request(const FitOption& option, const toml::node& node, const std::string& source,
                      FitRecord& record);

/// Range, choices, and the row's own check.
void check_option(const FitOption& option, const FitRecord& record);

/// What messages and docs expect: "a whole number 16..4096 (px)".
std::string describe_values(const FitOption& option);

/// As words on a command line: "0.5", "a,b", empty for nothing.
std::string to_words(const OptionValue& value);
/// As TOML; not of assignments and views, which are tables.
std::string to_toml(const OptionValue& value);

/// Shortest text that reads back to the same bits, always with a point or exponent (a TOML float).
std::string toml_number(double value);

}  // namespace espalier
