// A stem while it grows: where it starts, what it inherits from its parent and how far its splits
// have come. Metres. Equations: the 2017 dissertation [CH §3.2] and Weber & Penn 95 [WP].
#pragma once
#include <cstdint>

#include <espalier/core/random.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/plant/branch_path.h>
#include <espalier/weber_penn/scalar/stem_turtle.h>
#include <espalier/weber_penn/table/branch_parameters.h>
#include <espalier/weber_penn/table/parameters.h>

namespace espalier {

/// What the draws of a stem are for: with its path, a draw's address. New purposes go to the end.
enum class Draw : std::uint32_t {
  tree_scale,
  trunk_roll,
  trunk_length,
  trunk_place,
  trunk_lean,
  base_splits,
  child_length,
  child_count,
  child_rotation_start,
  child_rotation,
  child_down_angle,
  child_down_jitter,
  bend,
  curve,
  split_error,
  split_chance,
  split_angle,
  split_spread,
  helix_pitch,
  helix_radius,
  helix_roll,
  blossom
};

inline float draw_signed(RandomKey key, Draw purpose, int index = 0) {
  return uniform_signed(key, static_cast<std::uint32_t>(purpose), static_cast<std::uint32_t>(index));
}
inline float draw_unit(RandomKey key, Draw purpose, int index = 0) {
  return uniform_unit(key, static_cast<std::uint32_t>(purpose), static_cast<std::uint32_t>(index));
}

/// Shared by all stems of one trunk.
struct Tree {
  float scale_m = 0;                              ///< tree_scale [WP §4.2]
  float base_length_m = 0;                        ///< bare height of the trunk
  const BranchParameters* of_branches = nullptr;  ///< where some have parameters of their own; not owned
};

/// Degrees by which a stem bends more than the parameters say.
struct ExtraCurve {
  float whole_deg = 0, back_deg = 0;  ///< over its length; over its second half
  bool is_none() const { return whole_deg == 0 && back_deg == 0; }
};

struct GrowingStem {
  GrowingStem() {}  // NOLINT: not "= default", which would let emplace_back fill it with zeros first

  RandomKey key;
  int level = 0;
  std::int32_t parent = -1;  ///< index in Plant::stems
  std::int32_t origin = -1;  ///< likewise; for a clone: of the stem it splits off
  std::uint32_t child_index = 0;
  int path_length = 1;                       ///< parts of its path
  ChangeCursor cursor;                       ///< its overrides
  const WeberPennParameters* own = nullptr;  ///< parameters; null: the tree's
  const StemAxis* axis = nullptr;            ///< it follows; null: it bends as the parameters say
  ExtraCurve extra_curve;                    ///< by an override, or by training
  std::int32_t pad = -1;                     ///< the crown of a branch that it grows in, by number; -1: none
  Tree tree;
  StemTurtle turtle;    ///< at the start of the stem (for a clone: at the split)
  float length_m = 0;   ///< of the whole stem, also for a clone that starts midway
  float radius_m = 0;   ///< at the base of the whole stem
  float child_max = 0;  ///< longest child relative to this stem
  float offset_m = 0;   ///< of this stem along its parent
  float parent_length_m = 0;
  float parent_child_max = 0;
  // The state of splitting, handed on to clones.
  int first_segment = 0;
  float split_error = 0;  ///< of the error diffusion of seg_splits
  float clone_probability = 1;
  float branch_factor = 1;  ///< of child_share at each chance to split, not below 0.8; handed to clones
  float child_share = 1;    ///< of the children that an unsplit stem would bear per segment
  float split_correction_deg = 0;  ///< paid back at each later segment end
};

/// Those that the stem and its children grow by; `of_tree` are the tree's.
inline const WeberPennParameters& parameters_of(const GrowingStem& stem, const WeberPennParameters& of_tree) {
  return stem.own ? *stem.own : of_tree;
}

/// What overrides say of the stem's parameters, once its cursor is in place.
inline void find_parameters(GrowingStem& stem) {
  if (stem.tree.of_branches) stem.own = stem.tree.of_branches->of(stem.cursor.row_changes());
}

/// Other random numbers for a stem and all on it, where an override gives a seed.
constexpr RandomKey reseeded(RandomKey key, std::uint64_t seed) {
  return seed == 0 ? key : RandomKey{mix_bits(key.value ^ mix_bits(~seed))};
}

inline int segment_count(const WeberPennParameters& parameters, int level) {
  const int segments = static_cast<int>(parameters.curve_res[level_index(level)]);
  return segments > 1 ? segments : 1;
}

/// Where a child at `offset_m` along this stem is: 0 at the bare base, 1 at the tip.
inline float place_above_base(const GrowingStem& stem, float offset_m,
                              const WeberPennParameters& parameters) {
  const float bare = parameters.base_size[level_index(stem.level)];
  return (offset_m / stem.length_m - bare) / (1 - bare);
}

/// Of this stem: where it follows an axis, whole parts of those of its level, so fine that they follow it.
inline int segment_count(const GrowingStem& stem, const WeberPennParameters& parameters) {
  constexpr int kLeastOnAxis = 16;
  const int segments = segment_count(parameters, stem.level);
  return stem.axis ? (kLeastOnAxis + segments - 1) / segments * segments : segments;
}

/// Radius at z = 0 (base) … 1 (tip) by the four regimes of taper, with the flare of trunks [WP §4.4], times
/// radius_along.
float stem_radius_m(const GrowingStem& stem, float z, const WeberPennParameters& parameters);

}  // namespace espalier
