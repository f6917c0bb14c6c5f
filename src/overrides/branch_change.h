// What the overrides of one branch amount to once inheritance is worked out: for each quantity a number that
// replaces the model's, a factor and an offset, in this order. A value of the decomposition graph is explicit
// (replaced), inherited, or relative to what is inherited: an offset or a fraction
// [Boudon et al. 2003, Interactive design of bonsai tree models, §2.1 and §2.2].
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace espalier {

/// What of a branch can be overridden. Lengths and radii in metres, angles in degrees.
enum class Quantity : std::uint8_t {
  length,          ///< of the stem
  position,        ///< along the parent, 0 at its base to 1 at its tip
  down_angle,      ///< away from the parent's direction
  rotation,        ///< about the parent
  curvature,       ///< total bend of the stem, downwards
  curvature_back,  ///< bend of its second half, downwards: other than that of the first, the stem is an S
  radius,          ///< at the base
  child_count,     ///< of stems or leaves borne
  seed,            ///< a whole number that gives the branch and all on it other random numbers
  removed          ///< 1: the branch and all on it are gone
};
inline constexpr std::size_t kRelativeQuantities = 8;  ///< those that factors and offsets apply to

/// How an entry changes what is inherited.
enum class Relation : std::uint8_t { value, factor, offset };

template <typename Number>
struct ModificationOf {
  Number replaced_by = std::numeric_limits<Number>::quiet_NaN();  ///< NaN: not replaced
  Number factor = 1, offset = 0;

  Number apply(Number generated) const {
    return (std::isnan(replaced_by) ? generated : replaced_by) * factor + offset;
  }
  bool changes_nothing() const { return std::isnan(replaced_by) && factor == 1 && offset == 0; }
};

using Modification = ModificationOf<float>;

/// What one entry alone does.
template <typename Number>
ModificationOf<Number> modification(Relation relation, Number number) {
  ModificationOf<Number> result;
  if (relation == Relation::value) result.replaced_by = number;
  if (relation == Relation::factor) result.factor = number;
  if (relation == Relation::offset) result.offset = number;
  return result;
}

/// First `inherited`, then `own`; a replacement forgets what was before.
template <typename Number>
ModificationOf<Number> combined(const ModificationOf<Number>& inherited, const ModificationOf<Number>& own) {
  if (!std::isnan(own.replaced_by)) return own;
  return {inherited.replaced_by, inherited.factor * own.factor, inherited.offset * own.factor + own.offset};
}

struct BranchChange {
  std::array<Modification, kRelativeQuantities> modifications;
  std::uint64_t seed = 0;  ///< 0: the branch's own random numbers
  bool removed = false;

  const Modification& operator[](Quantity quantity) const {
    return modifications[static_cast<std::size_t>(quantity)];
  }
  Modification& operator[](Quantity quantity) { return modifications[static_cast<std::size_t>(quantity)]; }
};

/// `change` may be null: nothing is overridden.
inline float changed(const BranchChange* change, Quantity quantity, float generated) {
  return change ? (*change)[quantity].apply(generated) : generated;
}

}  // namespace espalier
