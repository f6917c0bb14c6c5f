#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include <espalier/core/error.h>
#include <espalier/core/toml/toml_file.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/overrides_toml.h>

namespace espalier {

namespace {

/// Those that are the same for all models; a parameter of the same name is reached by its level alone.
std::vector<std::string> own_keys(bool in_branch) {
  std::vector<std::string> keys = quantity_names();
  keys.insert(keys.end(), {"shares", "axis", "axis_frame", "crown", "locked"});
  if (in_branch) keys.emplace_back("path");
  return keys;
}

bool is_among(const std::string& key, const std::vector<std::string>& keys) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

std::vector<std::string> known_keys(bool in_branch, const ParameterTable& table) {
  std::vector<std::string> keys = own_keys(in_branch);
  for (std::string& key : parameter_keys(table)) keys.push_back(std::move(key));
  return keys;
}

Override read_override(const TomlSection& node, const std::string& key, Quantity quantity) {
  if (node.node(key).is_boolean()) return {quantity, Relation::value, node.flag(key) ? 1.0 : 0.0};
  const SaidInToml said = read_said(node, key);
  const auto number = toml_number(*said.number);
  if (!number)
    throw_input_error("{}: {}: got {}, expected a number", toml_location(node.source, *said.number), key,
                      describe_toml(*said.number));
  return {quantity, said.relation, *number, said.is_private};
}

AxisPoint read_axis_point(const TomlSection& node, const toml::node& element) {
  const toml::array* numbers = element.as_array();
  std::array<double, 3> point{};
  for (std::size_t i = 0; i < point.size(); ++i) {
    const auto number =
        numbers && numbers->size() == point.size() ? toml_number(*numbers->get(i)) : std::nullopt;
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

/// In the order of their keys, so that "taper[1]" comes after "taper".
void read_parameters_of_model(const TomlSection& node, const BranchPattern& pattern,
                              const ParameterTable& table, OverrideSet& set) {
  const std::vector<std::string> own = own_keys(true);
  for (const auto& [toml_key, value] : node.table) {
    const std::string key(toml_key.str());
    if (is_among(key, own)) continue;
    const ParameterOverride entry = read_parameter(node, key, table);
    check_level(entry, level_of(pattern), table, toml_location(node.source, value));
    set_parameter(set, entry);
  }
}

void read_set(const TomlSection& node, const BranchPattern& pattern, const ParameterTable& table,
              OverrideSet& set) {
  read_parameters_of_model(node, pattern, table, set);
  if (node.has("shares")) set.shares = node.text("shares");
  read_axis(node, set);
  if (node.has("locked")) set.is_locked = node.flag("locked");
  if (node.has("crown")) set.crown = read_crown(node.section("crown"));
  const std::vector<std::string> names = quantity_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!node.has(names[i])) continue;
    const Override entry = read_override(node, names[i], static_cast<Quantity>(i));
    check_override(entry, pattern, toml_location(node.source, node.node(names[i])));
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

void read_shared(const TomlSection& sets, const ParameterTable& table, Overrides& overrides) {
  for (const auto& [name, node] : sets.table) {
    const TomlSection set = sets.section(name.str());
    set.expect_only(known_keys(false, table));
    read_set(set, {}, table, overrides.shared[std::string(name.str())]);
  }
  for (const auto& [name, node] : sets.table) {  // also those that no branch shares
    const TomlSection set = sets.section(name.str());
    if (set.has("shares")) check_sharing(set, overrides.shared.at(std::string(name.str())), overrides);
  }
}

/// The nodes of single branches while they are read: a file may hold many, in any order.
class SingleBranches {
 public:
  explicit SingleBranches(std::vector<OverrideNode>& nodes) {
    for (OverrideNode& node : nodes) sets_.emplace(std::move(node.path), std::move(node.set));
  }

  OverrideSet& at(const BranchPath& path) { return sets_[path]; }

  void put_into(std::vector<OverrideNode>& nodes) {
    nodes.clear();
    nodes.reserve(sets_.size());
    for (auto& [path, set] : sets_) nodes.push_back({path, std::move(set)});
  }

 private:
  std::map<BranchPath, OverrideSet> sets_;
};

OverrideSet& set_of_range(const TomlSection& node, const BranchPattern& pattern, Overrides& overrides) {
  OverrideSet& set = overrides.set_of(pattern);
  if (overrides.ranges.size() > kMostRanges)
    throw_input_error("{}: path: got more than {} ranges of branches, expected fewer",
                      toml_location(node.source, node.node("path")), kMostRanges);
  return set;
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
  for (const ParameterOverride& entry : set.parameters) text += to_toml(entry);
  if (set.axis) text += axis_to_toml(*set.axis);
  if (set.is_locked) text += fmt::format("locked = {}\n", *set.is_locked);
  if (set.crown) text += crown_to_toml(*set.crown);
  return text;
}

}  // namespace

std::vector<std::string> override_keys() { return {"branch", "shared"}; }

void read_overrides(const TomlSection& preset, const ParameterTable& table, Overrides& overrides) {
  if (preset.has("shared")) read_shared(preset.section("shared"), table, overrides);
  if (!preset.has("branch")) return;
  SingleBranches single(overrides.nodes);
  for (const TomlSection& node : preset.sections("branch")) {
    node.expect_only(known_keys(true, table));
    if (!node.has("path"))
      throw_input_error("{}: got a branch without a path, expected path = \"0/3\"",
                        toml_location(node.source, node.table));
    const BranchPattern pattern =
        parse_branch_pattern(node.text("path"), toml_location(node.source, node.node("path")));
    const auto path = as_path(pattern);
    OverrideSet& set = path ? single.at(*path) : set_of_range(node, pattern, overrides);
    read_set(node, pattern, table, set);
    if (node.has("shares")) check_sharing(node, set, overrides);
  }
  single.put_into(overrides.nodes);
}

std::string overrides_to_toml(const Overrides& overrides) {
  std::string text;
  for (const auto& [name, set] : overrides.shared)
    text += fmt::format("\n[shared.{}]\n{}", quote_toml(name), set_to_toml(set));
  const auto add = [&](const auto& path, const OverrideSet& set) {
    text += fmt::format("\n[[branch]]\npath = \"{}\"\n{}", to_string(path), set_to_toml(set));
  };
  for (const RangeNode& node : overrides.ranges) add(node.pattern, node.set);
  for (const OverrideNode& node : overrides.nodes) add(node.path, node.set);
  return text;
}

}  // namespace espalier
