#include <espalier/core/error.h>
#include <espalier/image/masks/bits.h>
#include <espalier/image/masks/mask.h>

namespace espalier {

std::size_t area_px(const Mask& mask) { return count_bits(mask.words()); }

std::size_t differing_px(const Mask& a, const Mask& b) {
  ESPALIER_CHECK_EQ(a.width_px(), b.width_px());
  ESPALIER_CHECK_EQ(a.height_px(), b.height_px());
  return count_and_not(a.words(), b.words()) + count_and_not(b.words(), a.words());
}

Mask either(Mask a, const Mask& b) {
  for (std::size_t i = 0; i < a.words().size(); ++i) a.words()[i] |= b.words()[i];
  return a;
}

Mask both(Mask a, const Mask& b) {
  for (std::size_t i = 0; i < a.words().size(); ++i) a.words()[i] &= b.words()[i];
  return a;
}

Mask without(Mask a, const Mask& b) {
  for (std::size_t i = 0; i < a.words().size(); ++i) a.words()[i] &= ~b.words()[i];
  return a;
}

}  // namespace espalier
