// Networks that learn in a second what a test needs of them.
#pragma once
#include <espalier/fitting/posterior/summary_regression.h>

namespace espalier {

inline TrainingSettings small_training() {
  TrainingSettings training = posterior_training();
  training.hidden = {64, 64};
  return training;
}

}  // namespace espalier
