// Reads the parameters of a TOML table against a model's parameter table; no parameter by hand.
#pragma once
#include <toml++/toml.h>

#include <string>

#include <espalier/core/parameter_table.h>

namespace espalier {

/// Sets in `values` what `document` says; entries it does not name keep their value, as do the
/// levels beyond the end of a short array. Keys in `other_keys` are left to the caller.
/// Throws InputError (source, line, key, got, expected) for unknown keys, wrong types, values out of bounds.
void read_parameters(const toml::table& document, const std::string& source, const ParameterTable& table,
                     std::span<const std::string> other_keys, ParameterValues& values);

}  // namespace espalier
