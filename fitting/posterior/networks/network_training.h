// Networks that predict some numbers from others, by least squares: Adam (Kingma, Ba, arXiv:1412.6980, 2014)
// with decay of the weights apart from the gradient (Loshchilov, Hutter, arXiv:1711.05101, 2017), dropout
// (Srivastava et al., Journal of Machine Learning Research 15, 2014), and a step that rises and falls once
// (Smith, Topin, arXiv:1708.07120, 2017). One thread; the same key gives the same bits on every machine.
#pragma once
#include <cstddef>
#include <vector>

#include <espalier/core/random.h>
#include <espalier/fitting/posterior/networks/network.h>

namespace espalier {

struct TrainingSettings {
  std::vector<std::size_t> hidden = {256, 256};  ///< outputs of all layers but the last
  int epochs = 30;                               ///< times that each row is learnt from
  std::size_t batch = 128;  ///< rows of one step; the last ones of an epoch may be left out
  float dropout = 0.2F;     ///< share of hidden outputs that a step leaves out, in 256ths
  float step = 3e-3F;       ///< at its largest, after three tenths of the way
  float decay = 0.01F;      ///< of weights, in steps
};

/// `inputs` and `targets`: a row an example, at least `batch` of them, each column about as large as 1.
Network train_network(const FloatMatrix& inputs, const FloatMatrix& targets, const TrainingSettings& settings,
                      RandomKey key);

}  // namespace espalier
