// Curves along stems as growth evaluates them, made from the numbers in the table (core/curves/curve.h). A
// place x is from 0 to 1: of what is along itself from base to tip, of children from the parent's bare base
// to its tip.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace espalier {

/// A factor or an offset: four cubic pieces, of t = 4x - piece.
struct AlongCurve {
  static constexpr int kPieces = 4;
  bool is_neutral = true;                                    ///< changes nothing; has no value then
  std::array<std::array<float, kPieces>, 4> coefficients{};  ///< [power of t][piece]

  /// x that is no number, on a stem without length, is taken as 0.
  float at(float x) const {
    const float u = (x > 0 ? std::min(x, 1.f) : 0.f) * kPieces;
    const int piece = std::min(static_cast<int>(u), kPieces - 1);
    const float t = u - static_cast<float>(piece);
    const auto& c = coefficients;
    return ((c[3][piece] * t + c[2][piece]) * t + c[1][piece]) * t + c[0][piece];
  }
};

/// A density of children, as the share of them below a place; linear in each of some cells.
struct DensityCurve {
  static constexpr int kCells = 64;
  bool is_neutral = true;                   ///< the same everywhere; has no shares then
  std::array<float, kCells + 1> reached{};  ///< share below x = i / kCells
  std::array<float, kCells> per_share{};    ///< cells for each share of a cell; 0 where nothing grows
  /// For shares from j / kCells on: the last cell that begins at or below them.
  std::array<std::uint8_t, kCells> starts{};
  float end = 1;  ///< the place above which nothing grows

  float share_below(float x) const;

  /// Its inverse; where nothing grows, the far end, but for the last child. share: not below 0.
  float place_of(float share) const {
    if (share >= 1) return end;
    std::size_t cell = starts[static_cast<std::size_t>(share * kCells)];
    while (reached[cell + 1] <= share) ++cell;
    return (static_cast<float>(cell) + (share - reached[cell]) * per_share[cell]) / kCells;
  }
};

/// Of 7 numbers; neutral where all of them are `neutral`.
AlongCurve make_along_curve(std::span<const double> numbers, double neutral);

/// Of 7 numbers, none below 0; neutral where all of them are equal.
DensityCurve make_density_curve(std::span<const double> numbers);

/// A curve for each level, trunk = 0.
using AlongLevels = std::array<AlongCurve, 4>;
using DensityLevels = std::array<DensityCurve, 4>;

/// All that the table has; curves of children are of the children's level.
struct StemCurves {
  DensityLevels density_along;
  AlongLevels length_along, down_angle_along;
  AlongLevels curve_along, bend_along, radius_along;
  AlongCurve leaf_scale_along;
  DensityCurve leaf_density_along;
};

}  // namespace espalier
