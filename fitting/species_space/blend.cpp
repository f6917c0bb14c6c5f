#include <algorithm>
#include <cmath>

#include <espalier/core/field_error.h>
#include <espalier/fitting/species_space/blend.h>

namespace espalier {

namespace {

double between(double a, double b, double t) { return a == b ? a : (1 - t) * a + t * b; }

constexpr double kTurn = 0.5;  ///< where a choice goes from one plant to the other: to the nearer one

/// An effect that the other plant has not, gone where the other plant's takes over.
double fading(double a, double b, double t) {
  return a > 0 ? a * std::max(0.0, 1 - t / kTurn) : b * std::max(0.0, (t - kTurn) / (1 - kTurn));
}

/// Both plants with as many levels as the deeper one.
void deepen(const Model& model, ParameterValues& a, ParameterValues& b) {
  const auto row = model.table().find(Role::levels);
  if (!row) return;
  const int levels = static_cast<int>(std::max(a[*row], b[*row]));
  a = model.deepened(a, levels);
  b = model.deepened(b, levels);
}

/// A side that says nothing is the other plant's.
double choose(const Encoding& encoding, const EncodedValues& a, const EncodedValues& b, std::size_t choice,
              double t) {
  const std::size_t row = encoding.choices()[choice].row;
  if (is_nothing(encoding, a, row)) return b.choices[choice];
  if (is_nothing(encoding, b, row)) return a.choices[choice];
  return t < kTurn ? a.choices[choice] : b.choices[choice];
}

double mix(const Encoding& encoding, const EncodedValues& a, const EncodedValues& b, std::size_t column,
           double t) {
  const double from = a.numbers[column], to = b.numbers[column];
  if (a.means[column] != b.means[column]) return a.means[column] ? from : to;
  const bool one_sided = encoding.columns()[column].fades && (from == 0) != (to == 0);
  if (!one_sided) return between(from, to, t);
  const std::size_t row = encoding.columns()[column].row;
  const EncodedValues& other = from == 0 ? a : b;
  return is_nothing(encoding, other, row) ? between(from, to, t) : fading(from, to, t);
}

/// What is equal in both stays so to the last bit, but for rows that are written together with others.
void keep_equal(const Encoding& encoding, const ParameterValues& a, const ParameterValues& b,
                ParameterValues& values) {
  std::vector<bool> alone(values.size(), false);
  for (const EncodingColumn& column : encoding.columns()) alone[column.row] = !column.is_share;
  for (const EncodingChoice& choice : encoding.choices()) alone[choice.row] = true;
  for (std::size_t row = 0; row < values.size(); ++row)
    if (alone[row] && a[row] == b[row]) values[row] = a[row];
}

}  // namespace

ParameterValues blend(const Model& model, const Encoding& encoding, const ParameterValues& a,
                      const ParameterValues& b, double t) {
  if (!(t >= 0 && t <= 1)) throw_field_error("t", "got {}, expected a number 0 … 1", t);
  if (t == 0 || a == b) return a;
  if (t == 1) return b;
  ParameterValues deep_a = a, deep_b = b;
  if (encoding.levels_are_a_choice()) deepen(model, deep_a, deep_b);
  const EncodedValues from = encoding.encode(deep_a), to = encoding.encode(deep_b);
  EncodedValues mixed = from;
  for (std::size_t column = 0; column < mixed.numbers.size(); ++column)
    mixed.numbers[column] = mix(encoding, from, to, column, t);
  for (std::size_t choice = 0; choice < mixed.choices.size(); ++choice)
    mixed.choices[choice] = choose(encoding, from, to, choice, t);
  ParameterValues values = encoding.decode(mixed).values;
  keep_equal(encoding, deep_a, deep_b, values);
  const auto relaxed = model.table().find(Role::relaxed_counts);
  if (relaxed && encoding.levels_are_a_choice()) values[*relaxed] = 1;
  return values;
}

}  // namespace espalier
