// The draws of random.h for a vector of places or indices at a time: the same bits. For files that Highway
// compiles once per instruction set. No #pragma once: see Highway's guide.
#if defined(ESPALIER_CORE_RANDOM_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_CORE_RANDOM_LANES_INL_H
#undef ESPALIER_CORE_RANDOM_LANES_INL_H
#else
#define ESPALIER_CORE_RANDOM_LANES_INL_H
#endif

#include <array>
#include <bit>

#include <espalier/core/random.h>
#include <espalier/core/vector_math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

using Words = hn::CappedTag<std::uint64_t, kMostLanes>;
using WordLanes = hn::Vec<Words>;

/// mix_bits of each lane.
inline WordLanes mix_bits(WordLanes x) {
  const Words d;
  x = hn::Add(x, hn::Set(d, 0x9e3779b97f4a7c15ull));
  x = hn::Mul(hn::Xor(x, hn::ShiftRight<30>(x)), hn::Set(d, 0xbf58476d1ce4e5b9ull));
  x = hn::Mul(hn::Xor(x, hn::ShiftRight<27>(x)), hn::Set(d, 0x94d049bb133111ebull));
  return hn::Xor(x, hn::ShiftRight<31>(x));
}

/// Steps of SplitMix64 from a key to the draws of its indices.
alignas(64) constexpr std::array<std::uint64_t, kMostLanes> kIndexSteps = [] {
  std::array<std::uint64_t, kMostLanes> steps{};
  for (std::size_t i = 0; i < kMostLanes; ++i) steps[i] = i * 0x9e3779b97f4a7c15ull;
  return steps;
}();

/// What mix_bits makes a draw of: a key and the place of the draw, as in random_bits.
constexpr std::uint64_t before_mixing(RandomKey key, std::uint32_t purpose, std::uint32_t index) {
  return key.value + ((std::uint64_t{purpose} << 32) | index) * 0x9e3779b97f4a7c15ull;
}

/// uniform_signed of mixed bits; `words(i)`: what is mixed for lanes [i, i + Lanes(Words())).
template <typename WordsFrom>
HWY_INLINE Vector signed_from(const WordsFrom& words) {
  static_assert(std::endian::native == std::endian::little);
  const Words d;
  const hn::RebindToUnsigned<Floats> d32;
  alignas(64) std::array<std::uint64_t, kMostLanes> drawn;
  for (std::size_t i = 0; i < hn::Lanes(Floats()); i += hn::Lanes(d))
    hn::Store(hn::ShiftRight<40>(mix_bits(words(i))), d, &drawn[i]);
  hn::Vec<decltype(d32)> low, high;
  hn::LoadInterleaved2(d32, reinterpret_cast<const std::uint32_t*>(drawn.data()), low, high);
  const Vector unit =
      hn::Mul(hn::ConvertTo(Floats(), hn::BitCast(hn::RebindToSigned<Floats>(), low)), set(0x1p-24f));
  return hn::Sub(hn::Mul(set(2), unit), set(1));
}

/// uniform_signed(key, purpose, first + lane).
HWY_INLINE Vector signed_draws(RandomKey key, std::uint32_t purpose, std::uint32_t first) {
  const Words d;
  const auto start = hn::Set(d, before_mixing(key, purpose, first));
  return signed_from([&](std::size_t i) { return hn::Add(start, hn::Load(d, &kIndexSteps[i])); });
}

/// uniform_signed(keys[lane], purpose, index), for aligned keys.
HWY_INLINE Vector signed_draws(const std::uint64_t* keys, std::uint32_t purpose, std::uint32_t index) {
  const Words d;
  const auto place = hn::Set(d, before_mixing({0}, purpose, index));
  return signed_from([&](std::size_t i) { return hn::Add(hn::Load(d, keys + i), place); });
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
