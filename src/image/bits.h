// Counting the set bits of word arrays, and of what two arrays share. The counts are exact integers.
// Baseline x86-64 has no popcount instruction; these loops sum bits in parallel inside each word
// (Warren, Hacker's Delight, §5-1) and are simple enough for compilers to vectorise.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace espalier {

/// The number of set bits in each byte of `x`, in that byte (0..8).
constexpr std::uint64_t bits_of_bytes(std::uint64_t x) {
  x -= (x >> 1) & 0x5555555555555555ull;
  x = (x & 0x3333333333333333ull) + ((x >> 2) & 0x3333333333333333ull);
  return (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0full;
}

/// The sum of the eight bytes of `x`.
constexpr std::uint64_t sum_of_bytes(std::uint64_t x) {
  x = (x & 0x00ff00ff00ff00ffull) + ((x >> 8) & 0x00ff00ff00ff00ffull);
  x = (x & 0x0000ffff0000ffffull) + ((x >> 16) & 0x0000ffff0000ffffull);
  return (x + (x >> 32)) & 0xffffffffull;
}

/// Set bits of word_at(0..count-1). Bytes hold the counts of 31 words (at most 31·8 = 248) before they are
/// summed.
template <typename WordAt>
std::size_t count_words(std::size_t count, WordAt word_at) {
  std::size_t total = 0;
  for (std::size_t first = 0; first < count; first += 31) {
    std::uint64_t bytes = 0;
    const std::size_t end = std::min(first + 31, count);
    for (std::size_t i = first; i < end; ++i) bytes += bits_of_bytes(word_at(i));
    total += sum_of_bytes(bytes);
  }
  return total;
}

using Words = std::span<const std::uint64_t>;

inline std::size_t count_bits(Words a) {
  return count_words(a.size(), [&](std::size_t i) { return a[i]; });
}
/// Bits set in both; `a` and `b` have the same length, as below.
inline std::size_t count_and(Words a, Words b) {
  return count_words(a.size(), [&](std::size_t i) { return a[i] & b[i]; });
}
/// Bits set in `a` only.
inline std::size_t count_and_not(Words a, Words b) {
  return count_words(a.size(), [&](std::size_t i) { return a[i] & ~b[i]; });
}

}  // namespace espalier
