// Children of stems, leaves or stems, that wait to be turned into place many at a time: where each sits on
// its parent's curve, and the angles by which it leaves it. Metres and degrees.
#pragma once
#include <array>
#include <cstdint>

namespace espalier {

/// A column for each number. Whole vectors are written: some rows beyond `count` hold nothing.
struct WaitingChildren {
  static constexpr int kMost = 256;
  template <typename T>
  using Column = std::array<T, kMost + 8>;
  struct Columns3 {
    alignas(64) Column<float> x, y, z;
  };
  int count = 0;
  Columns3 point;    ///< on the parent's axis
  Columns3 tangent;  ///< along it, of any length
  Columns3 across;  ///< forward × right at the segment's end: with the tangent it spans the plane of `right`
  Columns3 right;   ///< of the unrolled frame
  alignas(64) Column<float> parent_radius_m, roll_deg, down_deg;
  alignas(64) Column<float> roll_sine, roll_cosine, down_sine, down_cosine;
  alignas(64) Column<float> offset_m;      ///< along the parent
  alignas(64) Column<float> growth;        ///< of the child's size; what it is relative to, the owner knows
  alignas(64) Column<std::int32_t> index;  ///< along the parent, from its base
};

}  // namespace espalier
