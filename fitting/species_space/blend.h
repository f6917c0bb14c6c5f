// A point between two plants. Coordinates in the species space and the residual that the plane does not hold
// are interpolated alike; since the projection is linear, that is interpolating the encoded values
// themselves, which is what is done here. At t = 0 and t = 1 the plants come back bit for bit
// (docs/species_space.md).
#pragma once
#include <espalier/fitting/species_space/encoding.h>
#include <espalier/plant/model.h>

namespace espalier {

/// The plant at t (0 … 1) between `a` and `b`, values of model.table(); those that are equal in both keep
/// their value. What means something to one of them only is taken from it; a choice goes to the nearer one.
/// Throws InputError for t outside 0 … 1.
ParameterValues blend(const Model& model, const Encoding& encoding, const ParameterValues& a,
                      const ParameterValues& b, double t);

}  // namespace espalier
