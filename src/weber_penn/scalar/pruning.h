// Pruning: shortening a stem until it stays inside the envelope or a user's volume [CH §3.2.1 Pruning].
#pragma once
#include <espalier/environment/volume.h>
#include <espalier/weber_penn/scalar/stem_walk.h>

namespace espalier {

/// The length the stem keeps, in metres; 0 where it is dropped. `volume` replaces the parametric envelope
/// and prunes fully unless prune_ratio says how far.
float pruned_length_m(const GrowingStem& stem, const WeberPennParameters& parameters, const Volume* volume);

/// Makes the stem fit into the volume: shortened a little, else bent along the border, else shortened until
/// it fits; its length is 0 where nothing is left.
void train_stem(GrowingStem& stem, const WeberPennParameters& parameters, const Volume& volume);

}  // namespace espalier
