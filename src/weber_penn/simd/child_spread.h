// How the children of a stem that does not split spread over its segments, all at once: the counts and the
// spacing of ChildPlacer (children.h), which takes a stem segment by segment. Degrees; all else has no unit.
#pragma once
#include <span>
#include <vector>

#include <espalier/weber_penn/scalar/children.h>

namespace espalier {

/// Child k sits in the segment in which the running count passes k + 1. Memory is kept from stem to stem.
class ChildSpread {
 public:
  /// Forgets what stems of a level share, for another plant.
  void clear() { parts_.clear(); }

  /// Not for fans and whorls.
  static bool supports(float child_count, int child_level, const WeberPennParameters& parameters);

  /// `count`: leaf_count or child_stem_count of the stem.
  void spread(const GrowingStem& stem, float count, const ChildSpacing& spacing,
              const WeberPennParameters& parameters);

  int first() const { return first_; }  ///< the first child above the bare base
  int end() const { return end_; }
  /// How far the last child has grown, where it is not whole (relaxed counts); else 1.
  float last_growth() const { return last_growth_; }

  // For each segment, with a vector more that can be read: the running count before it, and the children
  // that are passed at its end.
  const float* reached_before() const { return reached_.data(); }
  const float* whole() const { return whole_.data(); }
  float inverse_rate() const { return inverse_rate_; }  ///< segments per child
  float odd_shift() const { return distribution_; }     ///< by which odd children sit lower, in children
  /// Where on its segment each child sits, in [0, 1], where they are not evenly spread, with a vector more
  /// that can be read; else nullptr.
  const float* places() const { return are_placed_ ? places_.data() : nullptr; }

 private:
  float place(int child, int segments) const;
  template <typename Rate>
  float pass(int segments, const Rate& rate);
  void share_parts(int level, const ChildSpacing& spacing, int segments);
  void put_apart(float count, const ChildSpacing& spacing);

  int first_ = 0, end_ = 0;
  float last_growth_ = 1, inverse_rate_ = 0, distribution_ = 0;
  bool are_placed_ = false;
  int level_ = 0;                          ///< whose stems share the parts
  std::vector<ChildSpacing::Part> parts_;  ///< the segments, where children are not evenly spread
  std::vector<float> reached_, whole_, places_;
};

/// The angles of children about their parent: child k is at start_deg + by_child_deg[k], for a vector more
/// than there are children.
struct ChildRolls {
  float start_deg;
  const float* by_child_deg;
};

/// Where nothing is random, all stems of a level share one table.
class RollTable {
 public:
  /// Forgets what was drawn, for another plant.
  void clear() { shared_deg_.clear(); }

  /// The rolls of the first `count` children; good until the next call.
  ChildRolls rolls(const GrowingStem& stem, int count, const WeberPennParameters& parameters);

 private:
  void extend_shared(std::size_t count, float rotate_deg);
  void draw_own(const GrowingStem& stem, int count, float rotate_deg, float most_deg);

  int level_ = 0;  ///< whose stems share the table
  std::vector<float> shared_deg_, own_deg_;
};

}  // namespace espalier
