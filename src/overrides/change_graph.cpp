// The walk along the graph, and what sets amount to with what they share; change_graph_builder.cpp makes it.
#include <algorithm>
#include <map>

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

}  // namespace

std::vector<const OverrideSet*> sharing_chain(const OverrideSet& set, const Overrides& overrides) {
  std::vector<const OverrideSet*> chain{&set};
  while (!chain.back()->shares.empty()) {
    const std::string& name = chain.back()->shares;
    const OverrideSet* next = &shared_set(name, overrides);
    if (std::find(chain.begin(), chain.end(), next) != chain.end())
      throw_input_error("overrides: shared set '{}' leads back to itself, expected no cycle", name);
    if (chain.size() > kLongestSharing)
      throw_input_error("overrides: got a chain of more than {} shared sets, expected fewer",
                        kLongestSharing);
    chain.push_back(next);
  }
  return chain;
}

std::vector<Override> resolved_overrides(const OverrideSet& set, const Overrides& overrides) {
  const std::vector<const OverrideSet*> chain = sharing_chain(set, overrides);
  OverrideSet result;
  for (auto each = chain.rbegin(); each != chain.rend(); ++each)
    for (const Override& entry : (*each)->overrides) set_override(result, entry);
  return result.overrides;
}

std::vector<RowOverride> resolved_rows(const OverrideSet& set, const Overrides& overrides) {
  const std::vector<const OverrideSet*> chain = sharing_chain(set, overrides);
  std::map<std::uint32_t, RowOverride> by_row;
  for (auto each = chain.rbegin(); each != chain.rend(); ++each)
    for (const ParameterOverride& entry : (*each)->parameters)
      for (const auto& [row, number] : entry.rows)
        by_row[row] = {row, entry.relation, number, entry.is_private};
  std::vector<RowOverride> rows;
  rows.reserve(by_row.size());
  for (const auto& [row, entry] : by_row) rows.push_back(entry);
  return rows;
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

std::optional<bool> resolved_lock(const OverrideSet& set, const Overrides& overrides) {
  for (const OverrideSet* each : sharing_chain(set, overrides))
    if (each->is_locked) return each->is_locked;
  return std::nullopt;
}

ChangeCursor::ChangeCursor(const ChangeGraph* graph) : graph_(graph), node_(graph ? 0 : -1) {}

ChangeCursor ChangeCursor::child(std::uint32_t index, float position) const {
  ChangeCursor below = *this;
  if (graph_ == nullptr) return below;
  below.node_ = -1;
  if (node_ < 0) return below;
  const ChangeGraph::Node& node = graph_->nodes_[static_cast<std::size_t>(node_)];
  below.inherits_ = node.hands_on ? node_ : -1;
  const auto after = std::upper_bound(node.first_index.begin(), node.first_index.end(), index);
  if (after == node.first_index.begin()) return below;
  const auto column = std::upper_bound(node.first_position.begin(), node.first_position.end(), position) -
                      node.first_position.begin();
  const auto row = after - node.first_index.begin() - 1;
  const auto columns = static_cast<std::ptrdiff_t>(node.first_position.size()) + 1;
  below.node_ = node.children[static_cast<std::size_t>(row * columns + column)];
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

std::int32_t ChangeCursor::row_changes() const {
  if (node_ > 0) return graph_->nodes_[static_cast<std::size_t>(node_)].rows;
  if (inherits_ >= 0) return graph_->nodes_[static_cast<std::size_t>(inherits_)].rows_handed_on;
  return -1;
}

bool ChangeCursor::is_locked() const {
  const std::int32_t at = node_ > 0 ? node_ : inherits_;
  return at >= 0 && graph_->nodes_[static_cast<std::size_t>(at)].is_locked;
}

std::span<const std::uint32_t> ChangeCursor::nodes() const {
  if (node_ <= 0) return {};
  return graph_->nodes_[static_cast<std::size_t>(node_)].said_by;
}

}  // namespace espalier
