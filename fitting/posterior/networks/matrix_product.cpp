#undef HWY_TARGET_INCLUDE
// NOLINTNEXTLINE(bugprone-macro-parentheses): a name of a file
#define HWY_TARGET_INCLUDE <espalier/fitting/posterior/networks/matrix_product.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <espalier/core/error.h>
#include <espalier/fitting/posterior/networks/matrix_product.h>

#ifndef ESPALIER_FITTING_POSTERIOR_NETWORKS_PRODUCT_SHAPE
#define ESPALIER_FITTING_POSTERIOR_NETWORKS_PRODUCT_SHAPE
namespace espalier {

/// The first matrix of a product by the steps between its numbers, the second and the result by rows.
struct ProductShape {
  const float* a = nullptr;
  std::size_t row_step = 0, inner_step = 0;
  const float* b = nullptr;
  std::size_t rows = 0, inner = 0, columns = 0;
  float* result = nullptr;
};

}  // namespace espalier
#endif

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Rows of the result that are summed together: their sums stay in registers.
constexpr std::size_t kRows = 4;

/// Sums of kRows rows and two vectors of columns. Products are rounded before they are added: a fused step
/// would give other bits where there is none.
template <class D>
void sum_block(D d, const ProductShape& shape, std::size_t row, std::size_t column) {
  using V = hn::Vec<D>;
  const std::size_t lanes = hn::Lanes(d);
  const float* a = shape.a + row * shape.row_step;
  const float* b = shape.b + column;
  V left0 = hn::Zero(d), left1 = left0, left2 = left0, left3 = left0;
  V right0 = left0, right1 = left0, right2 = left0, right3 = left0;
  for (std::size_t k = 0; k < shape.inner; ++k, a += shape.inner_step, b += shape.columns) {
    const V left = hn::LoadU(d, b), right = hn::LoadU(d, b + lanes);
    const V a0 = hn::Set(d, a[0]), a1 = hn::Set(d, a[shape.row_step]), a2 = hn::Set(d, a[2 * shape.row_step]),
            a3 = hn::Set(d, a[3 * shape.row_step]);
    left0 = hn::Add(left0, hn::Mul(a0, left)), right0 = hn::Add(right0, hn::Mul(a0, right));
    left1 = hn::Add(left1, hn::Mul(a1, left)), right1 = hn::Add(right1, hn::Mul(a1, right));
    left2 = hn::Add(left2, hn::Mul(a2, left)), right2 = hn::Add(right2, hn::Mul(a2, right));
    left3 = hn::Add(left3, hn::Mul(a3, left)), right3 = hn::Add(right3, hn::Mul(a3, right));
  }
  float* result = shape.result + row * shape.columns + column;
  hn::StoreU(left0, d, result), hn::StoreU(right0, d, result + lanes);
  hn::StoreU(left1, d, result += shape.columns), hn::StoreU(right1, d, result + lanes);
  hn::StoreU(left2, d, result += shape.columns), hn::StoreU(right2, d, result + lanes);
  hn::StoreU(left3, d, result += shape.columns), hn::StoreU(right3, d, result + lanes);
}

/// Sums of one row and one vector of columns: what blocks leave over.
template <class D>
void sum_vector(D d, const ProductShape& shape, std::size_t row, std::size_t column) {
  const float* a = shape.a + row * shape.row_step;
  const float* b = shape.b + column;
  auto sum = hn::Zero(d);
  for (std::size_t k = 0; k < shape.inner; ++k, a += shape.inner_step, b += shape.columns)
    sum = hn::Add(sum, hn::Mul(hn::Set(d, *a), hn::LoadU(d, b)));
  hn::StoreU(sum, d, shape.result + row * shape.columns + column);
}

void sum_product(const ProductShape& shape) {
  const hn::ScalableTag<float> d;
  const hn::CappedTag<float, 1> one;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t column = 0;
  for (; column + 2 * lanes <= shape.columns; column += 2 * lanes) {
    std::size_t row = 0;
    for (; row + kRows <= shape.rows; row += kRows) sum_block(d, shape, row, column);
    for (; row < shape.rows; ++row) {
      sum_vector(d, shape, row, column);
      sum_vector(d, shape, row, column + lanes);
    }
  }
  for (; column + lanes <= shape.columns; column += lanes)
    for (std::size_t row = 0; row < shape.rows; ++row) sum_vector(d, shape, row, column);
  for (; column < shape.columns; ++column)
    for (std::size_t row = 0; row < shape.rows; ++row) sum_vector(one, shape, row, column);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier {

HWY_EXPORT(sum_product);

namespace {

void shape_result(std::size_t rows, std::size_t columns, FloatMatrix& result) {
  result.rows = rows;
  result.columns = columns;
  result.numbers.resize(rows * columns);
}

}  // namespace

FloatMatrix transposed(const FloatMatrix& matrix) {
  FloatMatrix result(matrix.columns, matrix.rows);
  for (std::size_t i = 0; i < matrix.rows; ++i)
    for (std::size_t j = 0; j < matrix.columns; ++j) result.row(j)[i] = matrix.row(i)[j];
  return result;
}

void multiply(const FloatMatrix& a, const FloatMatrix& b, FloatMatrix& result) {
  ESPALIER_CHECK_EQ(a.columns, b.rows);
  shape_result(a.rows, b.columns, result);
  HWY_DYNAMIC_DISPATCH(sum_product)
  (ProductShape{a.numbers.data(), a.columns, 1, b.numbers.data(), a.rows, a.columns, b.columns,
                result.numbers.data()});
}

void multiply_transposed(const FloatMatrix& a, const FloatMatrix& b, FloatMatrix& result) {
  ESPALIER_CHECK_EQ(a.rows, b.rows);
  shape_result(a.columns, b.columns, result);
  HWY_DYNAMIC_DISPATCH(sum_product)
  (ProductShape{a.numbers.data(), 1, a.columns, b.numbers.data(), a.columns, a.rows, b.columns,
                result.numbers.data()});
}

}  // namespace espalier
#endif
