// What a parameter is to a fit, whatever its model calls it. A model's table says which rows bear which
// roles; thinning, measures of pictures, tracing and palms ask the table for roles and know no names.
// A role that goes by level is of stems of one level of branching: branch_count[1] is of those on the trunk.
// Lengths are metres, or the model's own units where a row bears length_unit.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace espalier {

enum class Role : std::uint8_t {
  none,
  levels,                ///< of branching, the trunk included
  relaxed_counts,        ///< a switch: 1 lets relaxable counts be fractions
  length_unit,           ///< metres of one of the model's own units
  tree_scale,            ///< the length of the trunk of a plain tree, by which all of it scales
  tree_scale_variation,  ///< of it from tree to tree
  trunk_count,
  trunk_ratio,   ///< radius over length
  trunk_radius,  ///< of a model that has no ratio
  trunk_flare,   ///< widening at the foot, as a fraction of the radius
  trunk_taper,   ///< 0 a cylinder, 1 a cone
  trunk_segments,
  trunk_bend,            ///< from foot to top, degrees
  trunk_bend_variation,  ///< at random, degrees
  trunk_form,            ///< splits, bends or varies the trunk besides; any number of rows
  crown_base,            ///< height of the lowest branch, as a fraction of the trunk
  branch_count,          ///< by level; of the stems on each parent
  branch_length,         ///< by level; relative to the parent's
  branch_radius,         ///< by level; a factor
  radius_power,          ///< how strongly radii shrink from a stem to those it bears
  leaf_count,            ///< on each stem that bears leaves
  leaf_length,
  leaf_width,    ///< relative to the length
  blossom_share  ///< of the leaves that are blossom
};

/// A role and, where it goes by level, the level it is of; else -1.
struct RoleOfLevel {
  Role role = Role::none;
  int level = -1;
  bool operator==(const RoleOfLevel&) const = default;
};

/// Whether there is one such role for each level above the trunk.
bool goes_by_level(Role role);

/// "leaf_count", "branch_count[1]"; empty for none.
std::string role_name(RoleOfLevel role);

/// The inverse; a role that goes by level is of level 1 where the name has none. Throws InputError naming the
/// closest role for any other name, and for levels outside 1..3.
RoleOfLevel role_by_name(std::string_view name);

}  // namespace espalier
