// Counting the set bits of word arrays, and of what two arrays share. The counts are exact integers, the
// same for all instruction sets.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace espalier {

/// The number of set bits in each byte of `x`, in that byte (0..8): Warren, Hacker's Delight, §5-1.
constexpr std::uint64_t bits_of_bytes(std::uint64_t x) {
  x -= (x >> 1) & 0x5555555555555555ull;
  x = (x & 0x3333333333333333ull) + ((x >> 2) & 0x3333333333333333ull);
  return (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0full;
}

using Words = std::span<const std::uint64_t>;

std::size_t count_bits(Words a);
/// Bits set in both; `a` and `b` have the same length, as below.
std::size_t count_and(Words a, Words b);
/// Bits set in `a` only.
std::size_t count_and_not(Words a, Words b);

}  // namespace espalier
