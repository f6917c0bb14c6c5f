// Counts set bits vector by vector, for files that Highway compiles once per instruction set.
#if defined(ESPALIER_IMAGE_BIT_COUNTER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_IMAGE_BIT_COUNTER_INL_H
#undef ESPALIER_IMAGE_BIT_COUNTER_INL_H
#else
#define ESPALIER_IMAGE_BIT_COUNTER_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// D: a tag of 64-bit words. Bits are summed in parallel inside each word (Warren, Hacker's Delight, §5-1).
/// Its bytes hold the counts of 31 vectors (at most 31·8 = 248) before they are summed.
template <class D>
class BitCounter {
  using V = hn::Vec<D>;

 public:
  /// Written out: a default one would not be compiled for the instruction set.
  BitCounter() : bytes_(hn::Zero(D())), sums_(hn::Zero(D())) {}
  void add(V words) {
    words = hn::Sub(words, every(hn::ShiftRight<1>(words), 0x5555555555555555));
    words = hn::Add(every(words, 0x3333333333333333), every(hn::ShiftRight<2>(words), 0x3333333333333333));
    bytes_ = hn::Add(bytes_, every(hn::Add(words, hn::ShiftRight<4>(words)), 0x0f0f0f0f0f0f0f0f));
    if (++in_bytes_ == 31) sum_bytes();
  }
  std::size_t total() {
    sum_bytes();
    return hn::GetLane(hn::SumOfLanes(D(), sums_));
  }

 private:
  static V every(V words, std::uint64_t bits) { return hn::And(words, hn::Set(D(), bits)); }

  void sum_bytes() {
    V sum = hn::Add(every(bytes_, 0x00ff00ff00ff00ff), every(hn::ShiftRight<8>(bytes_), 0x00ff00ff00ff00ff));
    sum = hn::Add(every(sum, 0x0000ffff0000ffff), every(hn::ShiftRight<16>(sum), 0x0000ffff0000ffff));
    sums_ = hn::Add(sums_, every(hn::Add(sum, hn::ShiftRight<32>(sum)), 0xffffffff));
    bytes_ = hn::Zero(D());
    in_bytes_ = 0;
  }

  V bytes_, sums_;
  int in_bytes_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
