// Overrides made ready for growing: inheritance and sharing are worked out once, and a stem finds what
// changes it by a step from its parent. A model carries a ChangeCursor in each growing stem, moves it with
// child(), and applies change() where it computes the quantity. Where nodes of ranges and of single branches
// meet, a place of the graph stands for the branches that the same nodes are of. Immutable: threads may share
// it.
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
  /// `position`: of the child along its parent as the model places it, 0 to 1; of trunks and of stems that
  /// split off it means nothing.
  ChangeCursor child(std::uint32_t index, float position = 0) const;
  /// What changes the stem here; null: nothing.
  const BranchChange* change() const;
  /// Which parameters of the model the stem has for itself: a number in the graph's row_changes(); -1: none.
  std::int32_t row_changes() const;
  /// The drawn axis of this very stem; null: none.
  const StemAxis* axis() const;
  /// What the stem's own node says, without what it inherits: of a stem that splits off another, which has
  /// followed all that already. Null: nothing.
  const BranchChange* own_change() const;
  /// The crown of this very stem; null: none.
  const BranchCrown* crown() const;
  /// Whether fits leave the stem as it is.
  bool is_locked() const;
  /// The nodes of this very stem, the weakest first: numbers in Overrides::nodes, and beyond them those in
  /// Overrides::ranges.
  std::span<const std::uint32_t> nodes() const;
  /// Whether branches below this stem are changed in any way.
  bool changes_below() const { return node_ >= 0 || inherits_ >= 0; }

 private:
  const ChangeGraph* graph_ = nullptr;
  std::int32_t node_ = -1;      ///< of this very path; -1: none
  std::int32_t inherits_ = -1;  ///< the node whose public overrides hold here; -1: none
};

/// What rows of the model's table are for some branches.
struct BranchRows {
  RowChanges changes;
  bool is_of_split = false;      ///< of a stem that splits off another
  std::int32_t splits_off = -1;  ///< the rows of that one, likewise; -1: the tree's
  int level = 0;                 ///< of the branch, trunks being 0
};

class ChangeGraph {
 public:
  /// Throws InputError for a shared set that is unknown, that leads back to itself or that shares more than
  /// kLongestSharing others in a row, and for ranges that overlap in too many ways.
  explicit ChangeGraph(const Overrides& overrides);
  bool empty() const { return nodes_.size() == 1; }
  /// By number; what is refined from another comes after it.
  std::span<const BranchRows> row_changes() const { return rows_; }

 private:
  friend class ChangeCursor;
  friend class ChangeGraphBuilder;

  struct Node {
    BranchChange own;        ///< what it says itself
    BranchChange change;     ///< of the branch itself
    BranchChange handed_on;  ///< of those below without a node of their own
    std::int32_t rows = -1, rows_handed_on = -1;
    bool hands_on = false;  ///< whether anything holds for those below
    bool is_locked = false;
    std::optional<StemAxis> axis;
    std::optional<BranchCrown> crown;
    std::vector<std::uint32_t> said_by;  ///< as ChangeCursor::nodes()

    /// Children from first_index[i] on, below first_index[i + 1], that stand from first_position[j - 1] on,
    /// below first_position[j]: children[i · (positions + 1) + j], -1 where no node is of them.
    std::vector<std::uint32_t> first_index;
    std::vector<float> first_position;
    std::vector<std::int32_t> children;
  };

  std::vector<Node> nodes_;  ///< the first stands above the trunks
  std::vector<BranchRows> rows_;
};

/// Of sets that share one another, in a row.
inline constexpr std::size_t kLongestSharing = 64;

/// The set, what it shares, what that shares, and so on. Throws InputError as the graph does.
std::vector<const OverrideSet*> sharing_chain(const OverrideSet& set, const Overrides& overrides);

/// The overrides of `set`, those it shares first. Throws InputError as the graph does.
std::vector<Override> resolved_overrides(const OverrideSet& set, const Overrides& overrides);
/// The same of rows of the model's table, each once.
std::vector<RowOverride> resolved_rows(const OverrideSet& set, const Overrides& overrides);
/// Its axis, or that of the nearest set it shares; null: none. Throws InputError as the graph does.
const DrawnAxis* resolved_axis(const OverrideSet& set, const Overrides& overrides);
/// Its crown, or that of the nearest set it shares. Throws InputError as the graph does.
std::optional<BranchCrown> resolved_crown(const OverrideSet& set, const Overrides& overrides);
/// Whether it is locked, or the nearest set it shares that says so.
std::optional<bool> resolved_lock(const OverrideSet& set, const Overrides& overrides);

}  // namespace espalier
