#include <algorithm>

#include <espalier/core/error.h>
#include <espalier/overrides/change_graph.h>

namespace espalier {

namespace {

const OverrideSet& shared_set(const std::string& name, const Overrides& overrides) {
  const auto found = overrides.shared.find(name);
  if (found == overrides.shared.end())
    throw_input_error("overrides: got '{}' to share, expected the name of a shared set", name);
  return found->second;
}

void apply(const Override& entry, BranchChange& change) {
  const auto number = static_cast<float>(entry.number);
  if (entry.quantity == Quantity::seed) {
    change.seed = static_cast<std::uint64_t>(entry.number);
  } else if (entry.quantity == Quantity::removed) {
    change.removed = entry.number != 0;
  } else {
    Modification own;
    if (entry.relation == Relation::value) own.replaced_by = number;
    if (entry.relation == Relation::factor) own.factor = number;
    if (entry.relation == Relation::offset) own.offset = number;
    change[entry.quantity] = combined(change[entry.quantity], own);
  }
}

bool changes_anything(const BranchChange& change) {
  return !std::all_of(change.modifications.begin(), change.modifications.end(),
                      [](const Modification& m) { return m.changes_nothing(); });
}

/// A seed renews all that lies below its branch, and what is removed has nothing below it.
bool is_inherited(const Override& entry) {
  return !entry.is_private && entry.quantity != Quantity::seed && entry.quantity != Quantity::removed;
}

/// The set, what it shares, what that shares, and so on.
std::vector<const OverrideSet*> sharing_chain(const OverrideSet& set, const Overrides& overrides) {
  std::vector<const OverrideSet*> chain{&set};
  std::vector<std::string> names;
  while (!chain.back()->shares.empty()) {
    const std::string& name = chain.back()->shares;
    if (std::find(names.begin(), names.end(), name) != names.end())
      throw_input_error("overrides: shared set '{}' leads back to itself, expected no cycle", name);
    names.push_back(name);
    chain.push_back(&shared_set(name, overrides));
  }
  return chain;
}

}  // namespace

std::vector<Override> resolved_overrides(const OverrideSet& set, const Overrides& overrides) {
  const std::vector<const OverrideSet*> chain = sharing_chain(set, overrides);
  OverrideSet result;
  for (auto each = chain.rbegin(); each != chain.rend(); ++each)
    for (const Override& entry : (*each)->overrides) set_override(result, entry);
  return result.overrides;
}

const DrawnAxis* resolved_axis(const OverrideSet& set, const Overrides& overrides) {
  for (const OverrideSet* each : sharing_chain(set, overrides))
    if (each->axis) return &*each->axis;
  return nullptr;
}

std::optional<BranchCrown> resolved_crown(const OverrideSet& set, const Overrides& overrides) {
  for (const OverrideSet* each : sharing_chain(set, overrides))
    if (each->crown) return each->crown;
  return std::nullopt;
}

ChangeGraph::ChangeGraph(const Overrides& overrides) : nodes_(1) {
  std::vector<std::vector<Override>> own(1);
  for (const OverrideNode& node : overrides.nodes) {
    const auto index = static_cast<std::size_t>(add_path(node.path));
    own.resize(nodes_.size());
    own[index] = resolved_overrides(node.set, overrides);
    if (const DrawnAxis* axis = resolved_axis(node.set, overrides))
      nodes_[index].axis = StemAxis{make_axis(axis->points), axis->frame};
    nodes_[index].crown = resolved_crown(node.set, overrides);
  }
  combine(0, -1, own);
}

/// Nodes on the way that say nothing themselves are made too.
std::int32_t ChangeGraph::add_path(const BranchPath& path) {
  std::int32_t at = 0;
  for (const std::uint32_t index : path) {
    auto& children = nodes_[static_cast<std::size_t>(at)].children;
    const auto place = std::lower_bound(children.begin(), children.end(), std::pair{index, -1});
    if (place != children.end() && place->first == index) {
      at = place->second;
      continue;
    }
    const auto made = static_cast<std::int32_t>(nodes_.size());
    children.insert(place, {index, made});
    nodes_.emplace_back();
    at = made;
  }
  return at;
}

void ChangeGraph::combine(std::int32_t index, std::int32_t inherits,
                          const std::vector<std::vector<Override>>& own) {
  Node& node = nodes_[static_cast<std::size_t>(index)];
  if (inherits >= 0) node.change = node.handed_on = nodes_[static_cast<std::size_t>(inherits)].handed_on;
  for (const Override& entry : own[static_cast<std::size_t>(index)]) {
    apply(entry, node.own);
    apply(entry, node.change);
    if (is_inherited(entry)) apply(entry, node.handed_on);
  }
  node.hands_on = changes_anything(node.handed_on);
  for (const auto& [child_index, child] : node.children) combine(child, node.hands_on ? index : -1, own);
}

ChangeCursor::ChangeCursor(const ChangeGraph* graph) : graph_(graph), node_(graph ? 0 : -1) {}

ChangeCursor ChangeCursor::child(std::uint32_t index) const {
  ChangeCursor below = *this;
  if (graph_ == nullptr) return below;
  below.node_ = -1;
  if (node_ < 0) return below;
  const ChangeGraph::Node& node = graph_->nodes_[static_cast<std::size_t>(node_)];
  below.inherits_ = node.hands_on ? node_ : -1;
  const auto found = std::lower_bound(node.children.begin(), node.children.end(), std::pair{index, -1});
  if (found != node.children.end() && found->first == index) below.node_ = found->second;
  return below;
}

const StemAxis* ChangeCursor::axis() const {
  if (node_ <= 0) return nullptr;
  const ChangeGraph::Node& node = graph_->nodes_[static_cast<std::size_t>(node_)];
  return node.axis ? &*node.axis : nullptr;
}

const BranchChange* ChangeCursor::own_change() const {
  return node_ > 0 ? &graph_->nodes_[static_cast<std::size_t>(node_)].own : nullptr;
}

const BranchCrown* ChangeCursor::crown() const {
  if (node_ <= 0) return nullptr;
  const std::optional<BranchCrown>& crown = graph_->nodes_[static_cast<std::size_t>(node_)].crown;
  return crown ? &*crown : nullptr;
}

const BranchChange* ChangeCursor::change() const {
  if (node_ > 0) return &graph_->nodes_[static_cast<std::size_t>(node_)].change;
  if (inherits_ >= 0) return &graph_->nodes_[static_cast<std::size_t>(inherits_)].handed_on;
  return nullptr;
}

}  // namespace espalier
