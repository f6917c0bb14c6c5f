#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include <espalier/core/error.h>
#include <espalier/fitting/posterior/networks/network_training.h>

namespace espalier {

namespace {

enum Purpose : std::uint32_t { kWeights = 0x6e6501, kOrder, kDropout };

/// Uniform, with the variance that keeps values as large from layer to layer: He et al.,
/// "Delving deep into rectifiers" (ICCV 2015).
NetworkLayer first_layer_state(std::size_t inputs, std::size_t outputs, RandomKey key) {
  NetworkLayer layer{FloatMatrix(inputs, outputs), std::vector<float>(outputs, 0.0F)};
  const float reach = std::sqrt(6.0F / static_cast<float>(inputs)) * 0.5F;
  for (std::size_t i = 0; i < layer.weights.numbers.size(); ++i)
    layer.weights.numbers[i] = reach * uniform_signed(key, kWeights, static_cast<std::uint32_t>(i));
  return layer;
}

Network untrained(std::size_t inputs, std::size_t outputs, const TrainingSettings& settings, RandomKey key) {
  std::vector<std::size_t> widths = {inputs};
  widths.insert(widths.end(), settings.hidden.begin(), settings.hidden.end());
  widths.push_back(outputs);
  Network network;
  network.layers.reserve(widths.size() - 1);
  for (std::size_t i = 0; i + 1 < widths.size(); ++i)
    network.layers.push_back(first_layer_state(widths[i], widths[i + 1], child_key(key, i)));
  return network;
}

/// Fisher, Yates.
void shuffle(std::vector<std::size_t>& rows, RandomKey key) {
  for (std::size_t i = rows.size(); i > 1; --i)
    std::swap(rows[i - 1], rows[random_bits(key, kOrder, static_cast<std::uint32_t>(i)) % i]);
}

void take_rows(const FloatMatrix& matrix, const std::size_t* rows, FloatMatrix& taken) {
  for (std::size_t i = 0; i < taken.rows; ++i) std::copy_n(matrix.row(rows[i]), matrix.columns, taken.row(i));
}

/// Negative numbers become zero, and a share of the others; what is left is so much larger.
void rectify_and_drop(FloatMatrix& values, float scale, std::uint32_t dropped_of_256, RandomKey key) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < values.numbers.size(); ++i, bits >>= 8) {
    if (i % 8 == 0) bits = random_bits(key, kDropout, static_cast<std::uint32_t>(i / 8));
    float& value = values.numbers[i];
    value = (bits & 0xff) >= dropped_of_256 && value > 0 ? scale * value : 0.0F;
  }
}

/// Numbers that Adam moves, and what it remembers of their gradients.
class MovingAverages {
 public:
  explicit MovingAverages(std::size_t count) : mean_(count), square_(count) {}

  /// `decay`: share of the numbers that a whole step takes away.
  void move(const std::vector<float>& gradient, float step, float decay, std::vector<float>& numbers) {
    constexpr float kMeanKept = 0.9F, kSquareKept = 0.999F, kLeast = 1e-8F;
    mean_left_ *= kMeanKept;
    square_left_ *= kSquareKept;
    const float mean_scale = step / (1 - mean_left_), square_scale = 1 / (1 - square_left_);
    const float kept = 1 - step * decay;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      mean_[i] = kMeanKept * mean_[i] + (1 - kMeanKept) * gradient[i];
      square_[i] = kSquareKept * square_[i] + (1 - kSquareKept) * gradient[i] * gradient[i];
      numbers[i] =
          kept * numbers[i] - mean_scale * mean_[i] / (std::sqrt(square_scale * square_[i]) + kLeast);
    }
  }

 private:
  std::vector<float> mean_, square_;
  float mean_left_ = 1, square_left_ = 1;
};

class Training {
 public:
  Training(const FloatMatrix& inputs, const FloatMatrix& targets, const TrainingSettings& settings,
           RandomKey key)
      : settings_(settings),
        dropped_of_256_(static_cast<std::uint32_t>(std::lround(256 * settings.dropout))),
        network_(untrained(inputs.columns, targets.columns, settings, key)),
        values_(network_.layers.size() + 1) {
    values_.front() = FloatMatrix(settings.batch, inputs.columns);
    for (const NetworkLayer& layer : network_.layers) {
      weight_averages_.emplace_back(layer.weights.numbers.size());
      bias_averages_.emplace_back(layer.biases.size());
    }
  }

  void learn_from(const FloatMatrix& inputs, const FloatMatrix& targets, const std::size_t* rows, float step,
                  RandomKey key) {
    take_rows(inputs, rows, values_.front());
    forward(key);
    errors_ = FloatMatrix(settings_.batch, targets.columns);
    take_rows(targets, rows, errors_);
    const auto count = static_cast<float>(errors_.numbers.size());
    for (std::size_t i = 0; i < errors_.numbers.size(); ++i)
      errors_.numbers[i] = 2 * (values_.back().numbers[i] - errors_.numbers[i]) / count;
    for (std::size_t layer = network_.layers.size(); layer-- > 0;) backward(layer, step);
  }

  Network take_network() { return std::move(network_); }

 private:
  float scale() const { return 256.0F / static_cast<float>(256 - dropped_of_256_); }

  void forward(RandomKey key) {
    for (std::size_t layer = 0; layer < network_.layers.size(); ++layer) {
      apply_layer(network_.layers[layer], values_[layer], values_[layer + 1]);
      if (layer + 1 < network_.layers.size())
        rectify_and_drop(values_[layer + 1], scale(), dropped_of_256_, child_key(key, layer));
    }
  }

  /// Moves a layer against its gradient, after the errors of its inputs were found.
  void backward(std::size_t index, float step) {
    NetworkLayer& layer = network_.layers[index];
    multiply_transposed(values_[index], errors_, weight_gradient_);
    bias_gradient_.assign(errors_.columns, 0.0F);
    for (std::size_t i = 0; i < errors_.rows; ++i)
      for (std::size_t j = 0; j < errors_.columns; ++j) bias_gradient_[j] += errors_.row(i)[j];
    if (index > 0) {
      multiply(errors_, transposed(layer.weights), earlier_errors_);
      for (std::size_t i = 0; i < earlier_errors_.numbers.size(); ++i)
        earlier_errors_.numbers[i] *= values_[index].numbers[i] > 0 ? scale() : 0.0F;
      std::swap(errors_, earlier_errors_);
    }
    weight_averages_[index].move(weight_gradient_.numbers, step, settings_.decay, layer.weights.numbers);
    bias_averages_[index].move(bias_gradient_, step, 0, layer.biases);
  }

  const TrainingSettings& settings_;
  std::uint32_t dropped_of_256_;
  Network network_;
  std::vector<FloatMatrix> values_;  ///< inputs, and outputs of each layer
  FloatMatrix errors_, earlier_errors_, weight_gradient_;
  std::vector<float> bias_gradient_;
  std::vector<MovingAverages> weight_averages_, bias_averages_;
};

/// Of the largest, `done` of the way: up along a line for three tenths, down along one to zero.
float step_share(float done) {
  constexpr float kRise = 0.3F;
  return done < kRise ? done / kRise : (1 - done) / (1 - kRise);
}

}  // namespace

Network train_network(const FloatMatrix& inputs, const FloatMatrix& targets, const TrainingSettings& settings,
                      RandomKey key) {
  ESPALIER_CHECK_EQ(inputs.rows, targets.rows);
  const std::size_t batches = inputs.rows / settings.batch;
  ESPALIER_CHECK_EQ(batches > 0, true);
  Training training(inputs, targets, settings, key);
  std::vector<std::size_t> rows(inputs.rows);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const auto steps = static_cast<float>(batches * static_cast<std::size_t>(settings.epochs));
  std::size_t step = 0;
  for (int epoch = 0; epoch < settings.epochs; ++epoch) {
    shuffle(rows, child_key(key, 100 + static_cast<std::size_t>(epoch)));
    for (std::size_t batch = 0; batch < batches; ++batch, ++step)
      training.learn_from(inputs, targets, rows.data() + batch * settings.batch,
                          settings.step * step_share((static_cast<float>(step) + 0.5F) / steps),
                          child_key(key, 1000 + step));
  }
  return training.take_network();
}

}  // namespace espalier
