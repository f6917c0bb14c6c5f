// de Boor's recursion: a cubic or lower B-spline of numbers or points at one place (A Practical Guide to
// Splines, ch. X).
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace espalier {

inline constexpr std::size_t kMostDegree = 3;

inline double between(double a, double b, double share) { return (1 - share) * a + share * b; }

/// The value at u of the spline with these numbers, or of points for which there is a between(). Its piece
/// `piece` holds u: knot(piece + degree) <= u <= knot(piece + degree + 1).
template <typename Value, typename Knot>
Value de_boor(std::span<const Value> values, const Knot& knot, std::size_t degree, std::size_t piece,
              double u) {
  std::array<Value, kMostDegree + 1> d{};
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(piece), degree + 1, d.begin());
  for (std::size_t r = 1; r <= degree; ++r)
    for (std::size_t j = degree; j >= r; --j) {
      const double lower = knot(piece + j), upper = knot(piece + j + degree + 1 - r);
      d[j] = between(d[j - 1], d[j], (u - lower) / (upper - lower));
    }
  return d[degree];
}

}  // namespace espalier
