// The knots of a batch of stems, appended to a plant's a vector of knots at a time. Metres.
#pragma once
#include <span>

#include <espalier/plant/plant.h>
#include <espalier/weber_penn/simd/stem_batch.h>

namespace espalier {

/// Whether the knots of stems of this level are their segment ends, with radii that vectors can compute.
bool has_plain_knots(int level, const WeberPennParameters& parameters);

/// Appends the knots of the batch's stems, and where those of the next stem begin.
void append_knots(std::span<const GrowingStem> stems, const StemBatch& batch,
                  const WeberPennParameters& parameters, Plant& plant);

}  // namespace espalier
