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

bool is_above(const BranchPath& above, const BranchPath& path) {
  return above.size() < path.size() && std::equal(above.begin(), above.end(), path.begin());
}

/// What the nearest nodes above hand on to the branch.
std::vector<std::string> inherited_by(const BranchPath& path, const Overrides& overrides) {
  std::vector<std::string> texts;
  for (const OverrideNode& node : overrides.nodes) {
    if (!is_above(node.path, path)) continue;
    for (const Override& entry : resolved_overrides(node.set, overrides))
      if (!entry.is_private && static_cast<std::size_t>(entry.quantity) < kRelativeQuantities)
        texts.push_back(fmt::format("{} from {}", describe(entry), to_string(node.path)));
  }
  return texts;
}

std::string describe(const OverrideNode& node, const Overrides& overrides) {
  std::vector<std::string> texts;
  for (const Override& entry : node.set.overrides) texts.push_back(describe(entry));
  if (node.set.axis)
    texts.push_back(fmt::format("axis of {} points in the frame of the {}", node.set.axis->points.size(),
                                kAxisFrames[static_cast<std::size_t>(node.set.axis->frame)]));
  if (node.set.crown) {
    const std::array<float, 4>& radius = node.set.crown->radius;
    texts.push_back(fmt::format("a crown of {:g} to the right, {:g} up, {:g} to the left, {:g} down",
                                radius[0], radius[1], radius[2], radius[3]));
  }
  if (!node.set.shares.empty()) texts.push_back(fmt::format("shares {}", node.set.shares));
  std::string text = fmt::format("{}", fmt::join(texts, ", "));
  const std::vector<std::string> inherited = inherited_by(node.path, overrides);
  if (!inherited.empty()) text += fmt::format("; inherits {}", fmt::join(inherited, ", "));
  return text;
}

}  // namespace

std::string overrides_tree(const Overrides& overrides, const std::function<bool(const BranchPath&)>& grows,
                           const std::string& prefix) {
  std::string text;
  for (const OverrideNode& node : overrides.nodes) {
    const std::string indent(2 * (node.path.size() - 1), ' ');
    const bool removed =
        std::any_of(node.set.overrides.begin(), node.set.overrides.end(),
                    [](const Override& o) { return o.quantity == Quantity::removed && o.number != 0; });
    text += fmt::format("{}{}{}: {}{}\n", prefix, indent, to_string(node.path), describe(node, overrides),
                        removed || grows(node.path) ? "" : " [dormant]");
  }
  return text;
}

}  // namespace espalier
