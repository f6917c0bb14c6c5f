#include <algorithm>
#include <array>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/core/near_name.h>
#include <espalier/core/parameter_role.h>
#include <espalier/core/parameter_table.h>

namespace espalier {

namespace {

struct RoleInfo {
  Role role;
  std::string_view name;
  bool by_level = false;
};

constexpr std::array kRoles{
    RoleInfo{Role::levels, "levels"},
    RoleInfo{Role::relaxed_counts, "relaxed_counts"},
    RoleInfo{Role::length_unit, "length_unit"},
    RoleInfo{Role::tree_scale, "tree_scale"},
    RoleInfo{Role::tree_scale_variation, "tree_scale_variation"},
    RoleInfo{Role::trunk_count, "trunk_count"},
    RoleInfo{Role::trunk_ratio, "trunk_ratio"},
    RoleInfo{Role::trunk_radius, "trunk_radius"},
    RoleInfo{Role::trunk_flare, "trunk_flare"},
    RoleInfo{Role::trunk_taper, "trunk_taper"},
    RoleInfo{Role::trunk_segments, "trunk_segments"},
    RoleInfo{Role::trunk_bend, "trunk_bend"},
    RoleInfo{Role::trunk_bend_variation, "trunk_bend_variation"},
    RoleInfo{Role::trunk_form, "trunk_form"},
    RoleInfo{Role::crown_base, "crown_base"},
    RoleInfo{Role::branch_count, "branch_count", true},
    RoleInfo{Role::branch_length, "branch_length", true},
    RoleInfo{Role::branch_radius, "branch_radius", true},
    RoleInfo{Role::radius_power, "radius_power"},
    RoleInfo{Role::leaf_count, "leaf_count"},
    RoleInfo{Role::leaf_length, "leaf_length"},
    RoleInfo{Role::leaf_width, "leaf_width"},
    RoleInfo{Role::blossom_share, "blossom_share"},
};

constexpr bool rows_follow_the_enum() {
  for (std::size_t i = 0; i < kRoles.size(); ++i)
    if (static_cast<std::size_t>(kRoles[i].role) != i + 1) return false;
  return static_cast<std::size_t>(Role::blossom_share) == kRoles.size();
}
static_assert(rows_follow_the_enum());

const RoleInfo& info_of(Role role) { return kRoles[static_cast<std::size_t>(role) - 1]; }

[[noreturn]] void refuse(std::string_view name) {
  std::vector<std::string> known(kRoles.size());
  std::transform(kRoles.begin(), kRoles.end(), known.begin(),
                 [](const RoleInfo& info) { return std::string(info.name); });
  throw_input_error("got role '{}', expected one like '{}'", name, closest_name(name, known));
}

}  // namespace

bool goes_by_level(Role role) { return role != Role::none && info_of(role).by_level; }

std::string role_name(RoleOfLevel role) {
  if (role.role == Role::none) return "";
  const RoleInfo& info = info_of(role.role);
  return info.by_level ? fmt::format("{}[{}]", info.name, role.level) : std::string(info.name);
}

RoleOfLevel role_by_name(std::string_view name) {
  const std::string_view word = name.substr(0, name.find('['));
  for (const RoleInfo& info : kRoles) {
    if (info.name != word) continue;
    if (word == name) return {info.role, info.by_level ? 1 : -1};
    for (int level = 1; info.by_level && level <= 3; ++level)
      if (name.substr(word.size()) == fmt::format("[{}]", level)) return {info.role, level};
    throw_input_error("got role '{}', expected {}", name,
                      info.by_level ? "a level 1 to 3" : fmt::format("'{}', which has no levels", word));
  }
  refuse(name);
}

}  // namespace espalier
