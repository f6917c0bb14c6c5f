// Children of a stem of which some are overridden, or of which only one is wanted. A child whose position is
// overridden may belong to another segment than its slot: it waits until the stem has all its segments.
#pragma once
#include <optional>
#include <vector>

#include <espalier/weber_penn/scalar/children.h>

namespace espalier {

class ChangedChildren {
 public:
  /// only: the one child to place; none: all. `placer` must outlive this.
  ChangedChildren(ChildPlacer& placer, std::optional<std::uint32_t> only) : placer_(placer), only_(only) {}

  /// Starts a segment, as the placer does; then next() yields children until it returns false.
  void begin(const GrowingStem& stem, const Segment& segment);
  bool next(ChildSite& site);

  /// After the last segment, `stem` as it was at its base; then next_waiting() yields the children that
  /// waited.
  void end(const GrowingStem& stem) { placer_.end(stem); }
  bool next_waiting(ChildSite& site);

 private:
  struct Waiting {
    ChildSlot slot;
    float z = 0;  ///< along the whole stem
    ChangeCursor cursor;
  };

  bool take(const ChildSlot& slot, ChildSite& site);
  bool next_of_fan(ChildSite& site);
  bool is_wanted(int index) const { return !only_ || *only_ == static_cast<std::uint32_t>(index); }

  ChildPlacer& placer_;
  std::optional<std::uint32_t> only_;
  const GrowingStem* stem_ = nullptr;
  std::vector<Segment> segments_;
  std::vector<Waiting> waiting_;
};

}  // namespace espalier
