// Random numbers that belong to places: a draw is a hash of (seed, path of the stem in the tree,
// purpose, index), with no state. A small change of one parameter then leaves every other draw as
// it was, and parts of a plant grow in any order with the same bits (docs/architecture.md).
// The hash is the finaliser of SplitMix64 (Steele, Lea, Flood 2014).
#pragma once
#include <cstdint>

namespace espalier {

using Seed = std::uint64_t;

/// The place of a draw: the root of a plant, or a stem on it.
struct RandomKey {
  std::uint64_t value = 0;
};

constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

constexpr RandomKey root_key(Seed seed) { return {mix_bits(seed ^ 0x6573706165726965ull)}; }

/// The key of the `index`-th child of the stem with key `parent`.
constexpr RandomKey child_key(RandomKey parent, std::uint64_t index) {
  return {mix_bits(parent.value ^ mix_bits(index + 1))};
}

/// All 64 bits of the draw for `purpose` and `index` at this place: a step of SplitMix64 from the key, far
/// from those of other keys, which are mixed themselves.
constexpr std::uint64_t random_bits(RandomKey key, std::uint32_t purpose, std::uint32_t index = 0) {
  constexpr std::uint64_t kGamma = 0x9e3779b97f4a7c15ull;
  return mix_bits(key.value + ((std::uint64_t{purpose} << 32) | index) * kGamma);
}

/// u: uniform in [0, 1), 24 bits.
constexpr float uniform_unit(RandomKey key, std::uint32_t purpose, std::uint32_t index = 0) {
  return static_cast<float>(random_bits(key, purpose, index) >> 40) * 0x1p-24f;
}

/// U: uniform in [-1, 1).
constexpr float uniform_signed(RandomKey key, std::uint32_t purpose, std::uint32_t index = 0) {
  return 2 * uniform_unit(key, purpose, index) - 1;
}

}  // namespace espalier
