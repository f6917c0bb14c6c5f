#include <espalier/weber_penn/table/branch_parameters.h>

namespace espalier {

namespace {

/// A stem that splits off goes on in the segments of the stem it left, and as a helix where that is one.
void keep_walk(const WeberPennParameters& stem, int level, WeberPennParameters& split) {
  const auto index = static_cast<std::size_t>(level_index(level));
  split.curve_res[index] = stem.curve_res[index];
  if ((split.curve_v[index] < 0) != (stem.curve_v[index] < 0)) split.curve_v[index] = stem.curve_v[index];
}

}  // namespace

BranchParameters::BranchParameters(std::span<const double> values, const ChangeGraph* changes) {
  if (changes == nullptr) return;
  own_.reserve(changes->row_changes().size());
  for (const BranchRows& rows : changes->row_changes()) {
    own_.push_back(weber_penn_parameters(changed_values(weber_penn_table(), values, rows.changes)));
    if (!rows.is_of_split) continue;
    const WeberPennParameters* stem = of(rows.splits_off);
    keep_walk(stem ? *stem : weber_penn_parameters(values), rows.level, own_.back());
  }
}

}  // namespace espalier
