// Reads the parameters of a TOML table against a model's parameter table; no parameter by hand.
#pragma once
#include <toml++/toml.h>

#include <string>

#include <espalier/core/parameter_table.h>

namespace espalier {

/// The rows that one TOML key sets, in the order of its array: the levels of "curve_v", the
/// components of "tropism" (tropism_x, _y, _z); one row for "g_scale" or "curve_v[2]"; none where
/// the key is unknown. Rows of curves have keys of their own, "length_along[1].3", and go together
/// by read_parameters alone.
std::vector<std::size_t> rows_of_key(const ParameterTable& table, std::string_view key);

/// Sets in `values` what `document` says; entries it does not name keep their value, as do the
/// levels beyond the end of a short array. Keys in `other_keys` are left to the caller.
/// Throws InputError (source, line, key, got, expected) for unknown keys, wrong types, values out of bounds.
void read_parameters(const toml::table& document, const std::string& source, const ParameterTable& table,
                     std::span<const std::string> other_keys, ParameterValues& values);

}  // namespace espalier
