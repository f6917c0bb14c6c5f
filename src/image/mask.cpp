#include "image/mask.h"

#include "image/bits.h"

namespace espalier {

std::size_t area_px(const Mask& mask) { return count_bits(mask.words()); }

}  // namespace espalier
