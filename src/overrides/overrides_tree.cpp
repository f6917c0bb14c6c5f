#include <algorithm>

#include <espalier/core/error.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/overrides_tree.h>

namespace espalier {

namespace {

std::string describe(const Override& entry) {
  const std::string name = quantity_name(entry.quantity);
  const std::string closing = entry.is_private ? " (private)" : "";
  switch (entry.relation) {
    case Relation::value:
      return entry.quantity == Quantity::removed ? "removed"
                                                 : fmt::format("{} = {:g}{}", name, entry.number, closing);
    case Relation::factor:
      return fmt::format("{} × {:g}{}", name, entry.number, closing);
    case Relation::offset:
      return fmt::format("{} {:+g}{}", name, entry.number, closing);
  }
  throw InternalError("unknown relation");
}

std::string describe(const ParameterOverride& entry) {
  const std::string numbers = entry.numbers.size() == 1
                                  ? fmt::format("{:g}", entry.numbers[0])
                                  : fmt::format("[{:g}]", fmt::join(entry.numbers, ", "));
  constexpr const char* kSigns[] = {"=", "×", "+"};  // in the order of Relation
  return fmt::format("{} {} {}{}", entry.key, kSigns[static_cast<std::size_t>(entry.relation)], numbers,
                     entry.is_private ? " (private)" : "");
}

/// Whether what the node says may hold for branches on those of its pattern.
bool is_above(const BranchPattern& above, const BranchPattern& pattern) {
  return above.size() < pattern.size() && std::equal(above.begin(), above.end(), pattern.begin());
}

/// What a set hands on, its own keys before those it shares.
void add_inherited(const OverrideSet& set, const std::string& from, const Overrides& overrides,
                   std::vector<std::string>& texts) {
  for (const Override& entry : resolved_overrides(set, overrides))
    if (!entry.is_private && static_cast<std::size_t>(entry.quantity) < kRelativeQuantities)
      texts.push_back(fmt::format("{} from {}", describe(entry), from));
  for (const OverrideSet* each : sharing_chain(set, overrides))
    for (const ParameterOverride& entry : each->parameters)
      if (!entry.is_private) texts.push_back(fmt::format("{} from {}", describe(entry), from));
}

/// What the nodes whose paths begin this one hand on to its branches.
std::vector<std::string> inherited_by(const BranchPattern& pattern, const Overrides& overrides) {
  std::vector<std::string> texts;
  for (const RangeNode& node : overrides.ranges)
    if (is_above(node.pattern, pattern)) add_inherited(node.set, to_string(node.pattern), overrides, texts);
  for (const OverrideNode& node : overrides.nodes)
    if (is_above(as_pattern(node.path), pattern))
      add_inherited(node.set, to_string(node.path), overrides, texts);
  return texts;
}

std::string describe(const BranchPattern& pattern, const OverrideSet& set, const Overrides& overrides) {
  std::vector<std::string> texts;
  for (const Override& entry : set.overrides) texts.push_back(describe(entry));
  for (const ParameterOverride& entry : set.parameters) texts.push_back(describe(entry));
  if (set.axis)
    texts.push_back(fmt::format("axis of {} points in the frame of the {}", set.axis->points.size(),
                                kAxisFrames[static_cast<std::size_t>(set.axis->frame)]));
  if (set.crown) {
    const std::array<float, 4>& radius = set.crown->radius;
    texts.push_back(fmt::format("a crown of {:g} to the right, {:g} up, {:g} to the left, {:g} down",
                                radius[0], radius[1], radius[2], radius[3]));
  }
  if (set.is_locked) texts.emplace_back(*set.is_locked ? "locked" : "not locked");
  if (!set.shares.empty()) texts.push_back(fmt::format("shares {}", set.shares));
  std::string text = fmt::format("{}", fmt::join(texts, ", "));
  const std::vector<std::string> inherited = inherited_by(pattern, overrides);
  if (!inherited.empty()) text += fmt::format("; inherits {}", fmt::join(inherited, ", "));
  return text;
}

bool removes(const OverrideSet& set) {
  return std::any_of(set.overrides.begin(), set.overrides.end(),
                     [](const Override& o) { return o.quantity == Quantity::removed && o.number != 0; });
}

}  // namespace

std::vector<std::size_t> count_branches(const Overrides& overrides,
                                        const std::vector<ChangeCursor>& stem_cursors) {
  std::vector<std::size_t> counts(overrides.nodes.size() + overrides.ranges.size(), 0);
  for (const ChangeCursor& cursor : stem_cursors)
    for (const std::uint32_t node : cursor.nodes()) ++counts[node];
  return counts;
}

std::string overrides_tree(const Overrides& overrides, const std::vector<std::size_t>& branches,
                           const std::string& prefix) {
  std::string text;
  const auto add = [&](const BranchPattern& pattern, const OverrideSet& set, const std::string& closing) {
    const std::string indent(2 * (pattern.size() - 1), ' ');
    text += fmt::format("{}{}{}: {}{}\n", prefix, indent, to_string(pattern),
                        describe(pattern, set, overrides), closing);
  };
  for (std::size_t i = 0; i < overrides.ranges.size(); ++i) {
    const RangeNode& node = overrides.ranges[i];
    const std::size_t count = branches[overrides.nodes.size() + i];
    const std::string of_count = count == 1 ? " [1 branch]" : fmt::format(" [{} branches]", count);
    add(node.pattern, node.set, removes(node.set) ? "" : count == 0 ? " [dormant]" : of_count);
  }
  for (std::size_t i = 0; i < overrides.nodes.size(); ++i) {
    const OverrideNode& node = overrides.nodes[i];
    add(as_pattern(node.path), node.set, removes(node.set) || branches[i] > 0 ? "" : " [dormant]");
  }
  return text;
}

}  // namespace espalier
