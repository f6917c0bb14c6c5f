// How much of a crown is wood, from whatever side: crowns whose leaves do not hide their branches.
#pragma once
#include <espalier/plant/plant.h>

namespace espalier {

/// The area that branches, trunks not among them, show across their length, in m².
double branch_area_m2(const Plant& plant);

/// The share of a crown's area that is wood: where branches and leaves are mixed at random, the share of its
/// pixels that show wood. 0 without either.
double wood_share(double branch_area_m2, double leaf_area_m2);

/// How far it is beyond what bundled species have; 0 up to there.
double wood_excess(double wood_share);

}  // namespace espalier
