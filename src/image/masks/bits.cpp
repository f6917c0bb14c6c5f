// Bits are counted a vector at a time (Highway): baseline x86-64 has no instruction that counts them.
#undef HWY_TARGET_INCLUDE
// NOLINTNEXTLINE(bugprone-macro-parentheses): a name of a file
#define HWY_TARGET_INCLUDE <espalier/image/masks/bits.cpp>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <espalier/image/masks/bit_counter-inl.h>
#include <espalier/image/masks/bits.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

/// Set bits of words_at(d, i), the vector of words from i on, for whole vectors from `first` on.
/// Moves `first` past them.
template <class D, class WordsAt>
std::size_t count_vectors(D d, std::size_t& first, std::size_t end, const WordsAt& words_at) {
  BitCounter<D> counter;
  const std::size_t lanes = hn::Lanes(d);
  for (; first + lanes <= end; first += lanes) counter.add(words_at(d, first));
  return counter.total();
}

template <class WordsAt>
std::size_t count_words(std::size_t size, const WordsAt& words_at) {
  std::size_t first = 0;
  const std::size_t in_vectors = count_vectors(hn::ScalableTag<std::uint64_t>(), first, size, words_at);
  return in_vectors + count_vectors(hn::CappedTag<std::uint64_t, 1>(), first, size, words_at);
}

std::size_t count(Words a) {
  return count_words(a.size(), [&](auto d, std::size_t i) { return hn::LoadU(d, &a[i]); });
}
std::size_t count_both(Words a, Words b) {
  return count_words(
      a.size(), [&](auto d, std::size_t i) { return hn::And(hn::LoadU(d, &a[i]), hn::LoadU(d, &b[i])); });
}
std::size_t count_first_only(Words a, Words b) {
  return count_words(
      a.size(), [&](auto d, std::size_t i) { return hn::AndNot(hn::LoadU(d, &b[i]), hn::LoadU(d, &a[i])); });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier {

HWY_EXPORT(count);
HWY_EXPORT(count_both);
HWY_EXPORT(count_first_only);

std::size_t count_bits(Words a) { return HWY_DYNAMIC_DISPATCH(count)(a); }
std::size_t count_and(Words a, Words b) { return HWY_DYNAMIC_DISPATCH(count_both)(a, b); }
std::size_t count_and_not(Words a, Words b) { return HWY_DYNAMIC_DISPATCH(count_first_only)(a, b); }

}  // namespace espalier
#endif
