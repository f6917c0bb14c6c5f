// Products of small matrices of floats, a vector of columns at a time (Highway). Each number of the result is
// summed in the order of the inner index, without fused rounding, so it has the same bits on every machine.
#pragma once
#include <cstddef>
#include <vector>

namespace espalier {

/// Rows one after the other.
struct FloatMatrix {
  FloatMatrix() = default;
  FloatMatrix(std::size_t rows, std::size_t columns)
      : rows(rows), columns(columns), numbers(rows * columns) {}

  float* row(std::size_t i) { return numbers.data() + i * columns; }
  const float* row(std::size_t i) const { return numbers.data() + i * columns; }

  std::size_t rows = 0, columns = 0;
  std::vector<float> numbers;
};

FloatMatrix transposed(const FloatMatrix& matrix);

/// a b; a has as many columns as b has rows. `result` keeps its memory.
void multiply(const FloatMatrix& a, const FloatMatrix& b, FloatMatrix& result);

/// aᵀ b; both have as many rows.
void multiply_transposed(const FloatMatrix& a, const FloatMatrix& b, FloatMatrix& result);

}  // namespace espalier
