// Overrides in a preset's TOML:
//   [[branch]]
//   path = "0/3"                                     # child 3 of trunk 0
//   length = { factor = 1.2 }                        # inherited by the branches on it
//   down_angle = { offset = -10, private = true }    # not inherited
//   radius = 0.1                                     # a value that replaces the model's
//   axis = [[0, 0, 0.3], [0.1, 0, 0.6], [0.3, 0, 0.8]]   # the curve it follows, not inherited
//   axis_frame = "world"                             # or "parent", which is the default
//   crown = { radius = 0.4, radius_up = 0.1 }        # a foliage pad, not inherited
//   "taper[1]" = 0.5                                 # a row of the model, or a curve: here as all else
//   shares = "low"                                   # what [shared.low] says comes first
#pragma once
#include <string>

#include <espalier/core/toml/toml_section.h>
#include <espalier/overrides/overrides.h>

namespace espalier {

/// The keys of a preset that hold overrides.
std::vector<std::string> override_keys();

/// Of one preset, with those that it extends: each branch is compared with all.
inline constexpr std::size_t kMostRanges = 1000;

/// Reads them into `overrides`: a node that is there already is changed quantity by quantity. `table` is the
/// model's. Throws InputError with file, line, key, got and expected.
void read_overrides(const TomlSection& preset, const ParameterTable& table, Overrides& overrides);

/// The text read_overrides reads back to the same bits; empty where nothing is overridden.
std::string overrides_to_toml(const Overrides& overrides);

}  // namespace espalier
