// Where children sit on a stem and which way they point: stems and leaves alike [CH §3.2.1 Branch
// Distribution, §3.2.2]. Metres and degrees.
#pragma once
#include <algorithm>
#include <array>

#include <espalier/weber_penn/scalar/child_spacing.h>
#include <espalier/weber_penn/scalar/stem_walk.h>

namespace espalier {

/// Where a child sits, before its turtle is worked out.
struct ChildSlot {
  int index = 0;             ///< along the parent, from its base
  float t = 0;               ///< along the segment, in [0, 1]
  float roll_deg = 0;        ///< about the parent
  float grown_fraction = 1;  ///< under 1 for the last child of a relaxed count
};

/// Children of one segment: child k of `count` is child first + k of the parent. Evenly spaced it sits at
/// t_start + k·t_step (t_odd further where k is odd) along the segment, clamped to it; else at t[k].
struct ChildRun {
  int first = 0, count = 0;
  float t_start = 0, t_step = 0, t_odd = 0;
  const float* t = nullptr;         ///< in [0, 1]; 7 numbers more can be read
  const float* roll_deg = nullptr;  ///< of each about the parent; 7 numbers more can be read
};

/// One place for a child on its parent's axis.
struct ChildSite {
  int index = 0;              ///< along the parent, from its base
  StemTurtle turtle;          ///< on the axis of the parent, heading along the child
  Vec3 outward;               ///< unit normal of the parent on the child's side
  float offset_m = 0;         ///< along the parent
  float parent_radius_m = 0;  ///< at the offset
  float grown_fraction = 1;   ///< under 1 for the last child of a relaxed count
  ChangeCursor cursor;        ///< its overrides
};

/// Expected number of child stems on a stem, not rounded; negative: that many in a fan at its tip.
float child_stem_count(const GrowingStem& stem, const WeberPennParameters& parameters);

/// Number of leaves on a stem of the last level; negative: that many in a fan at its tip.
float leaf_count(const GrowingStem& stem, const WeberPennParameters& parameters);

/// Places children segment by segment. The spread over segments is the error diffusion of [CH §3.2.1]:
/// child i appears in the segment in which the running count passes i + 1, at the middle of its share.
/// Segments are those of the stem's level; a stem that follows an axis is walked in parts of them.
class ChildPlacer {
 public:
  enum class Bears { stems, leaves };
  static constexpr int kMostInRun = 64;

  /// Counts are those above, for the whole stem if it were no clone and did not split.
  ChildPlacer(const GrowingStem& stem, Bears bears, const WeberPennParameters& parameters);

  /// Starts a segment, or a part of one, which must outlive its children, as must the stem; then next()
  /// yields them until it returns false.
  void begin(const GrowingStem& stem, const Segment& segment);
  bool next(ChildSite& site);

  /// The same without the turtle, except in fans; slots below the stem's base bear nothing.
  bool next_slot(ChildSlot& slot);

  /// Where along the whole stem the slot lies.
  float z_of(const ChildSlot& slot) const {
    return segment_->z_start + slot.t * (segment_->z_end - segment_->z_start);
  }

  /// False below the stem's base and where nothing has grown yet.
  bool is_borne(const ChildSlot& slot, float z) const {
    return z >= p_.base_size[level_index(stem_->level)] && slot.grown_fraction > 0;
  }

  /// After the last segment, for slots that are still to be placed: `stem` as it was at its base.
  void end(const GrowingStem& stem) { stem_ = &stem; }

  /// Works out a slot at t of any segment of the stem. `change` (may be null) is what overrides do to it.
  ChildSite place(const ChildSlot& slot, const Segment& segment, float t, const BranchChange* change) const;

  /// Whether the children are a fan at the tip, which has no slots: next() alone yields it.
  bool in_fan() const { return count_ < 0; }

  /// Takes whole children of the segment, as many as kMostInRun, until it returns false; not in fans or
  /// whorls. Their rolls are kept until the next run. next_slot() then yields what is left.
  bool next_run(ChildRun& run);

 private:
  bool next_along(ChildSlot& slot);
  bool next_in_whorl(ChildSlot& slot);
  bool next_in_fan(ChildSite& site);
  bool site_at(const ChildSlot& slot, ChildSite& site) const;
  float along_segment(float share) const;
  void put_apart(ChildRun& run);
  /// Whether a place on the whole segment lies beyond the step of it that has begun.
  bool is_further_on(float t) const { return step_ + 1 < steps_ && t * steps_ >= step_ + 1; }
  float on_step(float t) const { return std::clamp(t * steps_ - step_, 0.f, 1.f); }
  float next_rotation_deg();
  float jitter_deg(int index) const;
  float down_angle_deg(float offset_m, int index) const;
  float drawn_down_angle_deg(float offset_m, int index) const;

  const WeberPennParameters& p_;
  Bears bears_;
  const GrowingStem* stem_;
  const Segment* segment_ = nullptr;
  float count_;
  int child_level_;     ///< index of the child's level values
  float distribution_;  ///< branch_dist
  ChildSpacing spacing_;
  ChildSpacing::Part part_;            ///< of the segment, where children are not evenly spaced
  float reached_ = 0, before_ = 0;     ///< running count after and before this segment
  float share_ = 0;                    ///< of the children that the stem would bear unsplit
  float rate_ = 0, inverse_rate_ = 0;  ///< children per segment
  int whole_ = 0;                      ///< children that the running count has passed
  int placed_ = 0;                     ///< children so far
  int whorl_ = 0, in_whorl_ = 0;
  float rotation_deg_;
  bool last_segment_ = false;
  int steps_ = 1, step_ = 0;  ///< of a segment, where the stem follows an axis
  std::array<float, kMostInRun + 8> rolls_deg_, places_;
};

}  // namespace espalier
