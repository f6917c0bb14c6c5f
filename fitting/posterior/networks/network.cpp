#include <algorithm>

#include <espalier/fitting/posterior/networks/network.h>

namespace espalier {

void apply_layer(const NetworkLayer& layer, const FloatMatrix& inputs, FloatMatrix& outputs) {
  multiply(inputs, layer.weights, outputs);
  for (std::size_t i = 0; i < outputs.rows; ++i)
    for (std::size_t j = 0; j < outputs.columns; ++j) outputs.row(i)[j] += layer.biases[j];
}

FloatMatrix predict(const Network& network, const FloatMatrix& inputs) {
  FloatMatrix values = inputs, next;
  for (std::size_t i = 0; i < network.layers.size(); ++i) {
    apply_layer(network.layers[i], values, next);
    if (i + 1 < network.layers.size())
      for (float& value : next.numbers) value = std::max(value, 0.0F);
    std::swap(values, next);
  }
  return values;
}

}  // namespace espalier
