// The parametric model as a Model: what can be rendered, fitted, blended and exported.
#pragma once
#include <espalier/plant/model.h>

namespace espalier {

const Model& weber_penn_model();

}  // namespace espalier
