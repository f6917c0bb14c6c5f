// The parameters that single branches have for themselves: those of the tree with what overrides say of rows
// and curves [Boudon et al. 2003, Interactive design of bonsai tree models, §2.1: each node holds the
// parameters of its branching system].
#pragma once
#include <span>
#include <vector>

#include <espalier/overrides/change_graph.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier {

class BranchParameters {
 public:
  /// `values` are those of the tree, in the order of weber_penn_table(). `changes` may be null.
  BranchParameters(std::span<const double> values, const ChangeGraph* changes);

  bool empty() const { return own_.empty(); }
  /// By the number of ChangeCursor::row_changes(); null: those of the tree.
  const WeberPennParameters* of(std::int32_t number) const {
    return number < 0 ? nullptr : &own_[static_cast<std::size_t>(number)];
  }

 private:
  std::vector<WeberPennParameters> own_;
};

}  // namespace espalier
