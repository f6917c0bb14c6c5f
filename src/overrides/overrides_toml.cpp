#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

#include <espalier/core/error.h>
#include <espalier/core/toml/toml_file.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/overrides_toml.h>

namespace espalier {

namespace {

constexpr const char* kRelations[] = {"value", "factor", "offset"};  ///< in the order of Relation

std::vector<std::string> known_keys(bool in_branch) {
  std::vector<std::string> keys = quantity_names();
  keys.insert(keys.end(), {"shares", "axis", "axis_frame", "crown"});
  if (in_branch) keys.emplace_back("path");
  return keys;
}

/// { factor = 1.2, private = true }
void read_relation(const TomlSection& entry, Override& result) {
  entry.expect_only({"value", "factor", "offset", "private"});
  int found = 0;
  for (std::size_t i = 0; i < std::size(kRelations); ++i) {
    if (!entry.has(kRelations[i])) continue;
    result.relation = static_cast<Relation>(i);
    result.number = entry.number(kRelations[i]);
    ++found;
  }
  if (entry.has("private")) result.is_private = entry.flag("private");
  if (found != 1)
    throw_input_error("{}: got {} of value, factor and offset, expected one",
                      toml_location(entry.source, entry.table), found);
}

Override read_override(const TomlSection& node, const std::string& key, Quantity quantity) {
  Override result{.quantity = quantity};
  if (node.node(key).is_table())
    read_relation(node.section(key), result);
  else if (node.node(key).is_boolean())
    result.number = node.flag(key) ? 1 : 0;
  else
    result.number = node.number(key);
  return result;
}

AxisPoint read_axis_point(const TomlSection& node, const toml::node& element) {
  const toml::array* numbers = element.as_array();
  std::array<double, 3> point{};
  for (std::size_t i = 0; i < point.size(); ++i) {
    const auto number =
        numbers && numbers->size() == point.size() ? numbers->get(i)->value<double>() : std::nullopt;
    if (!number) node.fail("axis", "an array of points [x, y, z]");
    point[i] = *number;
  }
  return {point[0], point[1], point[2]};
}

std::vector<AxisPoint> read_axis_points(const TomlSection& node) {
  std::vector<AxisPoint> points;
  points.reserve(node.array("axis").size());
  for (const toml::node& element : node.array("axis")) points.push_back(read_axis_point(node, element));
  try {
    make_axis(points);
  } catch (const InputError& error) {
    throw_input_error("{}: axis: {}", toml_location(node.source, node.node("axis")), error.what());
  }
  return points;
}

/// axis = [[0, 0, 0.3], [0.1, 0, 0.6], [0.3, 0, 0.8]]
void read_axis(const TomlSection& node, OverrideSet& set) {
  if (node.has("axis")) set.axis = DrawnAxis{read_axis_points(node), AxisFrame::parent};
  if (!node.has("axis_frame")) return;
  if (!set.axis) node.fail("axis_frame", "none where no axis is drawn");
  const std::string name = node.text("axis_frame");
  const auto* const frame = std::find(std::begin(kAxisFrames), std::end(kAxisFrames), name);
  if (frame == std::end(kAxisFrames)) node.fail("axis_frame", "\"parent\" or \"world\"");
  set.axis->frame = static_cast<AxisFrame>(frame - std::begin(kAxisFrames));
}

/// crown = { radius = 0.4, radius_up = 0.1, shape = 2 }: "radius" is that of all sides that have none of
/// their own.
BranchCrown read_crown(const TomlSection& section) {
  BranchCrown crown;
  const std::vector<BranchCrownNumber> numbers = numbers_of(crown);
  std::vector<std::string> known = names_of_several();
  for (const BranchCrownNumber& each : numbers) known.push_back(each.name);
  section.expect_only(known);
  for (const BranchCrownNumber& each : numbers) {
    const std::string of_several = each.name.substr(0, each.name.find('_'));
    const std::string& key = section.has(each.name) ? each.name : of_several;
    if (!section.has(key)) continue;
    const auto value = static_cast<float>(section.number(key));
    if (!(value >= each.lower && value <= each.upper))
      section.fail(key, fmt::format("a number from {:g} to {:g}", each.lower, each.upper));
    *each.number = value;
  }
  return crown;
}

void read_set(const TomlSection& node, const BranchPath& path, OverrideSet& set) {
  if (node.has("shares")) set.shares = node.text("shares");
  read_axis(node, set);
  if (node.has("crown")) set.crown = read_crown(node.section("crown"));
  const std::vector<std::string> names = quantity_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!node.has(names[i])) continue;
    const Override entry = read_override(node, names[i], static_cast<Quantity>(i));
    check_override(entry, path, toml_location(node.source, node.node(names[i])));
    set_override(set, entry);
  }
}

/// Throws where the node's set is not there, or leads back to itself.
void check_sharing(const TomlSection& node, const OverrideSet& set, const Overrides& overrides) {
  try {
    resolved_overrides(set, overrides);
  } catch (const InputError& error) {
    throw_input_error("{}: {}", toml_location(node.source, node.node("shares")), error.what());
  }
}

void read_shared(const TomlSection& sets, Overrides& overrides) {
  for (const auto& [name, node] : sets.table) {
    const TomlSection set = sets.section(name.str());
    set.expect_only(known_keys(false));
    read_set(set, {}, overrides.shared[std::string(name.str())]);
  }
  for (const auto& [name, node] : sets.table) {  // also those that no branch shares
    const TomlSection set = sets.section(name.str());
    if (set.has("shares")) check_sharing(set, overrides.shared.at(std::string(name.str())), overrides);
  }
}

std::string override_to_toml(const Override& entry) {
  const std::string name = quantity_name(entry.quantity);
  if (entry.quantity == Quantity::removed) return fmt::format("{} = {}\n", name, entry.number != 0);
  if (entry.relation == Relation::value && !entry.is_private)
    return fmt::format("{} = {}\n", name, entry.number);
  return fmt::format("{} = {{ {} = {}{} }}\n", name, kRelations[static_cast<std::size_t>(entry.relation)],
                     entry.number, entry.is_private ? ", private = true" : "");
}

std::string axis_to_toml(const DrawnAxis& axis) {
  std::string text;
  for (const AxisPoint& point : axis.points)
    text += fmt::format("{}[{}, {}, {}]", text.empty() ? "" : ", ", point.x, point.y, point.z);
  const bool in_world = axis.frame == AxisFrame::world;
  return fmt::format("axis = [{}]\n{}", text, in_world ? "axis_frame = \"world\"\n" : "");
}

std::string crown_to_toml(BranchCrown crown) {
  std::vector<std::string> numbers;
  for (const BranchCrownNumber& each : numbers_of(crown))
    numbers.push_back(fmt::format("{} = {}", each.name, *each.number));
  return fmt::format("crown = {{ {} }}\n", fmt::join(numbers, ", "));
}

std::string set_to_toml(const OverrideSet& set) {
  std::string text;
  if (!set.shares.empty()) text += fmt::format("shares = {}\n", quote_toml(set.shares));
  for (const Override& entry : set.overrides) text += override_to_toml(entry);
  if (set.axis) text += axis_to_toml(*set.axis);
  if (set.crown) text += crown_to_toml(*set.crown);
  return text;
}

}  // namespace

std::vector<std::string> override_keys() { return {"branch", "shared"}; }

void read_overrides(const TomlSection& preset, Overrides& overrides) {
  if (preset.has("shared")) read_shared(preset.section("shared"), overrides);
  if (!preset.has("branch")) return;
  for (const TomlSection& node : preset.sections("branch")) {
    node.expect_only(known_keys(true));
    if (!node.has("path"))
      throw_input_error("{}: got a branch without a path, expected path = \"0/3\"",
                        toml_location(node.source, node.table));
    const BranchPath path =
        parse_branch_path(node.text("path"), toml_location(node.source, node.node("path")));
    OverrideSet& set = overrides.at(path).set;
    read_set(node, path, set);
    if (node.has("shares")) check_sharing(node, set, overrides);
  }
}

std::string overrides_to_toml(const Overrides& overrides) {
  std::string text;
  for (const auto& [name, set] : overrides.shared)
    text += fmt::format("\n[shared.{}]\n{}", quote_toml(name), set_to_toml(set));
  for (const OverrideNode& node : overrides.nodes)
    text += fmt::format("\n[[branch]]\npath = \"{}\"\n{}", to_string(node.path), set_to_toml(node.set));
  return text;
}

}  // namespace espalier
