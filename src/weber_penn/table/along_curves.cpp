#include <espalier/core/curves/curve.h>
#include <espalier/weber_penn/table/along_curves.h>

namespace espalier {

namespace {

using Piece = std::array<double, 4>;  ///< coefficients of the powers of t

bool are_all(std::span<const double> numbers, double value) {
  return std::all_of(numbers.begin(), numbers.end(), [&](double number) { return number == value; });
}

/// The cubic with the values and slopes of the curve at the ends of its piece: the curve itself.
std::array<Piece, AlongCurve::kPieces> pieces_of(std::span<const double> numbers) {
  Curve curve;
  std::copy(numbers.begin(), numbers.end(), curve.numbers.begin());
  std::array<Piece, AlongCurve::kPieces> pieces;
  constexpr double kWidth = 1.0 / AlongCurve::kPieces;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double start = static_cast<double>(i) * kWidth, end = start + kWidth;
    const double a = curve_value(curve, start), b = curve_value(curve, end);
    const double slope_a = kWidth * curve_slope(curve, start), slope_b = kWidth * curve_slope(curve, end);
    pieces[i] = {a, slope_a, 3 * (b - a) - 2 * slope_a - slope_b, 2 * (a - b) + slope_a + slope_b};
  }
  return pieces;
}

/// The integral of the curve up to x.
double integral(const std::array<Piece, AlongCurve::kPieces>& pieces, double x) {
  double sum = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double t = std::clamp(x * AlongCurve::kPieces - static_cast<double>(i), 0.0, 1.0);
    const Piece& c = pieces[i];
    sum += t * (c[0] + t * (c[1] / 2 + t * (c[2] / 3 + t * c[3] / 4)));
  }
  return sum / AlongCurve::kPieces;
}

/// What place_of looks up.
void prepare_places(DensityCurve& density) {
  const auto& reached = density.reached;
  const auto after = [&](float share) { return std::upper_bound(reached.begin(), reached.end(), share); };
  for (std::size_t i = 0; i < density.starts.size(); ++i) {
    const float share = static_cast<float>(i) / DensityCurve::kCells;
    density.starts[i] = static_cast<std::uint8_t>(after(share) - reached.begin() - 1);
    const float in_cell = reached[i + 1] - reached[i];
    density.per_share[i] = in_cell > 0 ? 1 / in_cell : 0;
  }
  const auto last = std::lower_bound(reached.begin(), reached.end(), 1.f);
  density.end = static_cast<float>(last - reached.begin()) / DensityCurve::kCells;
}

}  // namespace

float DensityCurve::share_below(float x) const {
  const float u = std::clamp(x, 0.f, 1.f) * kCells;
  const auto cell = std::min(static_cast<std::size_t>(u), reached.size() - 2);
  return reached[cell] + (u - static_cast<float>(cell)) * (reached[cell + 1] - reached[cell]);
}

AlongCurve make_along_curve(std::span<const double> numbers, double neutral) {
  AlongCurve along;
  along.is_neutral = are_all(numbers, neutral);
  if (along.is_neutral) return along;
  const auto pieces = pieces_of(numbers);
  for (std::size_t power = 0; power < 4; ++power)
    for (std::size_t piece = 0; piece < pieces.size(); ++piece)
      along.coefficients[power][piece] = static_cast<float>(pieces[piece][power]);
  return along;
}

DensityCurve make_density_curve(std::span<const double> numbers) {
  DensityCurve density;
  density.is_neutral = are_all(numbers, numbers[0]);
  if (density.is_neutral) return density;
  const auto pieces = pieces_of(numbers);
  const double whole = integral(pieces, 1);
  float before = 0;
  for (std::size_t i = 0; i < density.reached.size(); ++i) {
    const double x = static_cast<double>(i) / DensityCurve::kCells;
    before = std::max(before, static_cast<float>(integral(pieces, x) / whole));  // monotone when rounded
    density.reached[i] = before;
  }
  density.reached.back() = 1;
  prepare_places(density);
  return density;
}

}  // namespace espalier
