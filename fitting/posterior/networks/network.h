// A small network of layers: each row of numbers is multiplied by weights, biases are added, and what is
// negative becomes zero, but for the last layer (Goodfellow, Bengio, Courville, Deep Learning, 2016, chapter
// 6). The same bits on every machine.
#pragma once
#include <vector>

#include <espalier/fitting/posterior/networks/matrix_product.h>

namespace espalier {

struct NetworkLayer {
  FloatMatrix weights;  ///< a row an input, a column an output
  std::vector<float> biases;
};

struct Network {
  std::vector<NetworkLayer> layers;
};

/// Outputs of one layer, without its end: inputs · weights + biases. A row a row of `inputs`.
void apply_layer(const NetworkLayer& layer, const FloatMatrix& inputs, FloatMatrix& outputs);

/// Outputs of the last layer, a row a row of `inputs`.
FloatMatrix predict(const Network& network, const FloatMatrix& inputs);

}  // namespace espalier
