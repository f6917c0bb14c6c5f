// Random numbers of the optimisers: counter-based (core/random.h), so a draw belongs to a place of the
// search (seed, generation, individual) and not to the order in which others drew.
// Uniform numbers have 53 random bits; normals are Box and Muller's.
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include <espalier/core/random.h>

namespace espalier {

/// Consecutive draws at one place of a search. Copying it repeats the draws.
class RandomStream {
 public:
  explicit RandomStream(RandomKey key) : key_(key) {}

  std::uint64_t bits() { return random_bits(key_, kPurpose, next_++); }

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Uniform in [-1, 1).
  double uniform_signed() { return 2 * uniform() - 1; }

  bool chance(double probability) { return uniform() < probability; }

  /// A whole number in [0, count); count >= 1.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
  }

  /// Standard normal (Box and Muller 1958); takes two uniform draws.
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  static constexpr std::uint32_t kPurpose = 0x6f7074;  // keeps them apart from a plant's draws
  RandomKey key_;
  std::uint32_t next_ = 0;
};

/// The draws of individual `index` in generation (or batch) `generation`.
inline RandomStream random_stream_at(RandomKey key, std::uint64_t generation, std::uint64_t index) {
  return RandomStream(child_key(child_key(key, generation), index));
}

}  // namespace espalier
