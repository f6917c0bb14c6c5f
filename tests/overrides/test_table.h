// A table with a row of each kind, as no model has it.
#pragma once
#include <espalier/core/parameter_table.h>

namespace espalier {

inline void add_test_curve(const char* name, int level, CurveRole role, int deepest_branch,
                           ParameterTable& table) {
  table.curves.push_back({.name = name, .level = level, .first_row = table.rows.size(), .role = role});
  for (int point = 0; point < static_cast<int>(kCurveRows); ++point)
    table.rows.push_back({.name = name,
                          .level = level,
                          .point = point,
                          .upper = 10,
                          .default_value = 1,
                          .deepest_branch = deepest_branch});
}

/// size of any branch, 0 to 10; kind, a choice; count of levels 0 to 3, whole; tilt_x, _y, _z; whole, of the
/// plant alone; the curves along of levels 1 and 2, on trunks and on what they bear; the density dense.
inline const ParameterTable& test_table() {
  static const ParameterTable kTable = [] {
    ParameterTable table{"test", {}};
    table.rows.push_back({.name = "size", .upper = 10, .default_value = 4, .deepest_branch = kAnyBranch});
    table.rows.push_back({.name = "kind",
                          .upper = 2,
                          .scale = Scale::choice,
                          .choices = {"round", "flat", "long"},
                          .deepest_branch = kAnyBranch});
    for (int level = 0; level < 4; ++level)
      table.rows.push_back({.name = "count",
                            .level = level,
                            .upper = 50,
                            .scale = Scale::integer,
                            .default_value = 10,
                            .deepest_branch = level < 3 ? level : kAnyBranch});
    for (const char* name : {"tilt_x", "tilt_y", "tilt_z"})
      table.rows.push_back({.name = name, .lower = -1, .deepest_branch = kAnyBranch});
    table.rows.push_back({.name = "whole", .upper = 10});
    add_test_curve("along", 1, CurveRole::factor, 0, table);
    add_test_curve("along", 2, CurveRole::factor, 1, table);
    add_test_curve("dense", -1, CurveRole::density, kAnyBranch, table);
    return table;
  }();
  return kTable;
}

}  // namespace espalier
