// The lanes where a mask is set, moved to the front: for queues that take some lanes of many vectors.
// Highway's Compress copies its table at each call (version 1.0.3); here eight lanes are a permutation from a
// table that stays. For files that Highway compiles once per instruction set.
#if defined(ESPALIER_CORE_PACKING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_CORE_PACKING_INL_H
#undef ESPALIER_CORE_PACKING_INL_H
#else
#define ESPALIER_CORE_PACKING_INL_H
#endif

#include <array>
#include <bit>
#include <cstdint>

#include <espalier/core/vector_math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

/// For each set of eight lanes, their numbers from the lowest on.
inline constexpr std::array<std::array<std::uint8_t, 8>, 256> kLanesOfBits = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    std::size_t count = 0;
    for (std::uint8_t lane = 0; lane < 8; ++lane)
      if ((bits >> lane & 1) != 0) table[bits][count++] = lane;
  }
  return table;
}();

/// Moves lanes of floats and integers to the front, and stores them.
class Packing {
 public:
  using Integers = hn::RebindToSigned<Floats>;

  explicit Packing(hn::Mask<Integers> taken) : taken_(taken) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Integers(), taken, bits);
    bits_ = bits[0];
  }

  std::size_t count() const { return static_cast<std::size_t>(std::popcount(bits_)); }

  /// Writes whole vectors.
  template <typename D>
  void store(hn::Vec<D> v, D d, hn::TFromD<D>* to) const {
    if constexpr (hn::MaxLanes(Floats()) == 8) {
      const hn::Rebind<std::uint8_t, Integers> d8;
      const auto lanes = hn::PromoteTo(Integers(), hn::LoadU(d8, kLanesOfBits[bits_].data()));
      hn::StoreU(hn::TableLookupLanes(v, hn::IndicesFromVec(d, lanes)), d, to);
    } else {
      hn::CompressStore(v, hn::RebindMask(d, taken_), d, to);
    }
  }

 private:
  hn::Mask<Integers> taken_;
  std::uint32_t bits_;
};

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
