// Overrides made ready for growing: inheritance and sharing are worked out once, and a stem finds what
// changes it by a step from its parent. A model carries a ChangeCursor in each growing stem, moves it with
// child(), and applies change() where it computes the quantity. Immutable: threads may share it.
#pragma once
#include <optional>
#include <utility>
#include <vector>

#include <espalier/overrides/overrides.h>

namespace espalier {

class ChangeGraph;

/// The place of a stem in the graph. Valid as long as the graph.
class ChangeCursor {
 public:
  ChangeCursor() = default;
  explicit ChangeCursor(const ChangeGraph* graph);  ///< above the trunks; null: nothing is overridden
  ChangeCursor child(std::uint32_t index) const;
  /// What changes the stem here; null: nothing.
  const BranchChange* change() const;
  /// The drawn axis of this very stem; null: none.
  const StemAxis* axis() const;
  /// What the stem's own node says, without what it inherits: of a stem that splits off another, which has
  /// followed all that already. Null: nothing.
  const BranchChange* own_change() const;
  /// The crown of this very stem; null: none.
  const BranchCrown* crown() const;
  /// Whether branches below this stem are changed in any way.
  bool changes_below() const { return node_ >= 0 || inherits_ >= 0; }

 private:
  const ChangeGraph* graph_ = nullptr;
  std::int32_t node_ = -1;      ///< of this very path; -1: none
  std::int32_t inherits_ = -1;  ///< the node whose public overrides hold here; -1: none
};

class ChangeGraph {
 public:
  /// Throws InputError for a shared set that is unknown, or that leads back to itself.
  explicit ChangeGraph(const Overrides& overrides);
  bool empty() const { return nodes_.size() == 1; }

 private:
  friend class ChangeCursor;

  struct Node {
    BranchChange own;        ///< what it says itself
    BranchChange change;     ///< of the branch itself
    BranchChange handed_on;  ///< of those below without a node of their own
    bool hands_on = false;   ///< whether handed_on changes anything
    std::optional<StemAxis> axis;
    std::optional<BranchCrown> crown;
    std::vector<std::pair<std::uint32_t, std::int32_t>> children;  ///< by index
  };

  std::int32_t add_path(const BranchPath& path);
  void combine(std::int32_t node, std::int32_t inherits, const std::vector<std::vector<Override>>& own);

  std::vector<Node> nodes_;  ///< the first stands above the trunks
};

/// The overrides of `set`, those it shares first. Throws InputError as the graph does.
std::vector<Override> resolved_overrides(const OverrideSet& set, const Overrides& overrides);
/// Its axis, or that of the nearest set it shares; null: none. Throws InputError as the graph does.
const DrawnAxis* resolved_axis(const OverrideSet& set, const Overrides& overrides);
/// Its crown, or that of the nearest set it shares. Throws InputError as the graph does.
std::optional<BranchCrown> resolved_crown(const OverrideSet& set, const Overrides& overrides);

}  // namespace espalier
