// Products and networks: what they compute, that they learn, and that they do so to the same bits.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/fitting/posterior/networks/network.h>
#include <espalier/fitting/posterior/networks/network_training.h>

namespace espalier {
namespace {

FloatMatrix random_matrix(std::size_t rows, std::size_t columns, std::uint32_t purpose) {
  FloatMatrix matrix(rows, columns);
  for (std::size_t i = 0; i < matrix.numbers.size(); ++i)
    matrix.numbers[i] = uniform_signed(root_key(1), purpose, static_cast<std::uint32_t>(i));
  return matrix;
}

/// Rounded after each product and each sum, in the order of k.
float sum_in_order(const FloatMatrix& a, const FloatMatrix& b, std::size_t row, std::size_t column) {
  volatile float sum = 0;
  for (std::size_t k = 0; k < a.columns; ++k) {
    volatile float product = a.row(row)[k] * b.row(k)[column];
    sum = sum + product;
  }
  return sum;
}

RC_GTEST_PROP(MatrixProduct, IsTheSumsInOrderToTheLastBit, ()) {
  const auto size = [] { return static_cast<std::size_t>(*rc::gen::inRange(1, 70)); };
  const FloatMatrix a = random_matrix(size(), size(), 1), b = random_matrix(a.columns, size(), 2);
  FloatMatrix product, of_transposed;
  multiply(a, b, product);
  multiply_transposed(transposed(a), b, of_transposed);
  RC_ASSERT(product.rows == a.rows);
  RC_ASSERT(product.columns == b.columns);
  RC_ASSERT(product.numbers == of_transposed.numbers);
  for (std::size_t i = 0; i < a.rows; ++i)
    for (std::size_t j = 0; j < b.columns; ++j) RC_ASSERT(product.row(i)[j] == sum_in_order(a, b, i, j));
}

TEST(Network, RectifiesAllLayersButTheLast) {
  Network network;
  network.layers.resize(2);
  for (NetworkLayer& layer : network.layers) {
    layer.weights = FloatMatrix(2, 2);
    layer.weights.numbers = {1, -1, 0, 0};  // the first input, and its negative
    layer.biases = {0.5F, 0.25F};
  }
  FloatMatrix inputs(2, 2);
  inputs.numbers = {3, 9, -4, 9};
  const FloatMatrix outputs = predict(network, inputs);  // hidden: 3.5 and 0, then 0 and 4.25
  EXPECT_EQ(outputs.numbers, (std::vector<float>{4, -3.25F, 0.5F, 0.25F}));
}

struct Lesson {
  FloatMatrix inputs, targets;
};

/// A product of two inputs, which no line predicts, and an input that says nothing.
Lesson lesson(std::size_t rows, std::uint32_t purpose) {
  Lesson made{random_matrix(rows, 3, purpose), FloatMatrix(rows, 2)};
  for (std::size_t i = 0; i < rows; ++i) {
    const float* x = made.inputs.row(i);
    made.targets.row(i)[0] = 3 * x[0] * x[1];
    made.targets.row(i)[1] = x[0];
  }
  return made;
}

const TrainingSettings& small_settings() {
  static const TrainingSettings settings{.hidden = {32, 32}, .epochs = 20, .batch = 64, .dropout = 0};
  return settings;
}

/// Share of the first target's variance that is left in its prediction's errors.
double share_left(const Network& network, const Lesson& lesson) {
  const FloatMatrix outputs = predict(network, lesson.inputs);
  double errors = 0, squares = 0;
  for (std::size_t i = 0; i < outputs.rows; ++i) {
    errors += std::pow(outputs.row(i)[0] - lesson.targets.row(i)[0], 2);
    squares += std::pow(lesson.targets.row(i)[0], 2);
  }
  return errors / squares;
}

TEST(NetworkTraining, LearnsAProductAndTellsItOfRowsNotSeen) {
  const Lesson seen = lesson(4000, 1), unseen = lesson(1000, 2);
  const Network network = train_network(seen.inputs, seen.targets, small_settings(), root_key(1));
  EXPECT_LT(share_left(network, unseen), 0.02);
  TrainingSettings lines = small_settings();
  lines.hidden.clear();
  EXPECT_GT(share_left(train_network(seen.inputs, seen.targets, lines, root_key(1)), unseen), 0.9);
}

TEST(NetworkTraining, RepeatsToTheBitAndAnotherKeyGivesAnotherNetwork) {
  const Lesson seen = lesson(500, 1);
  TrainingSettings settings = small_settings();
  settings.dropout = 0.2F;
  const auto weights = [&](std::uint64_t key) {
    return train_network(seen.inputs, seen.targets, settings, root_key(key)).layers[1].weights.numbers;
  };
  EXPECT_EQ(weights(1), weights(1));
  EXPECT_NE(weights(1), weights(2));
}

Lesson noisy_lesson(std::size_t rows, std::uint32_t purpose) {
  Lesson made = lesson(rows, purpose);
  const FloatMatrix noise = random_matrix(rows, 2, purpose + 10);
  for (std::size_t i = 0; i < noise.numbers.size(); ++i) made.targets.numbers[i] += 2 * noise.numbers[i];
  return made;
}

/// How much worse a network predicts what it has not seen than what it learnt from.
double learnt_by_heart(float dropout) {
  const Lesson seen = noisy_lesson(300, 1), unseen = noisy_lesson(2000, 2);
  const TrainingSettings settings{.hidden = {64, 64}, .epochs = 300, .batch = 50, .dropout = dropout};
  const Network network = train_network(seen.inputs, seen.targets, settings, root_key(1));
  return share_left(network, unseen) - share_left(network, seen);
}

TEST(NetworkTraining, DropoutLearnsLessByHeart) {
  EXPECT_LT(learnt_by_heart(0.3F), 0.8 * learnt_by_heart(0));
}

TEST(NetworkTraining, DecayTakesAwayWeightsThatNothingNeeds) {
  const Lesson seen = lesson(1000, 1);
  TrainingSettings settings = small_settings();
  settings.hidden.clear();
  settings.decay = 0;
  const auto useless = [&] {
    return std::fabs(
        train_network(seen.inputs, seen.targets, settings, root_key(1)).layers[0].weights.row(2)[1]);
  };
  const float without = useless();
  settings.decay = 1000;
  EXPECT_LT(useless(), 0.1F * without + 1e-3F);
}

}  // namespace
}  // namespace espalier
