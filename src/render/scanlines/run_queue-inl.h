// Runs of pixels that wait to be set: vectors put theirs in a row, those without pixels left out, and all are
// set in one loop. How many lanes of a vector have pixels cannot be predicted; so no branch depends on it.
// For files that Highway compiles once per instruction set.
#if defined(ESPALIER_RENDER_RUN_QUEUE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_RENDER_RUN_QUEUE_INL_H
#undef ESPALIER_RENDER_RUN_QUEUE_INL_H
#else
#define ESPALIER_RENDER_RUN_QUEUE_INL_H
#endif

#include <array>

#include <espalier/core/packing-inl.h>
#include <espalier/render/scanlines/span.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {
namespace {

using Integers = hn::RebindToSigned<Floats>;
using IntegerLanes = hn::Vec<Integers>;

class RunQueue {
 public:
  explicit RunQueue(Mask& mask) : words_(mask.words().data()), words_per_row_(mask.words_per_row()) {}

  /// Pixels x, x + 1, … of `row` where `bits` has ones, from its lowest bit on, of those lanes that have any.
  HWY_INLINE void add(IntegerLanes row, IntegerLanes x, IntegerLanes bits) {
    const Integers di;
    const Packing packing(hn::Ne(bits, hn::Zero(di)));
    const auto word = hn::Add(hn::Mul(row, hn::Set(di, words_per_row_)), hn::ShiftRight<6>(x));
    packing.store(word, di, &word_[size_]);
    packing.store(hn::And(x, hn::Set(di, 63)), di, &shift_[size_]);
    packing.store(bits, di, &bits_[size_]);
    size_ += packing.count();
    if (size_ >= kMost) flush();
  }

  /// Sets the pixels, and empties the queue.
  void flush() {
    for (std::size_t i = 0; i < size_; ++i)
      set_bits(words_ + word_[i], shift_[i], static_cast<std::uint32_t>(bits_[i]));
    size_ = 0;
  }

 private:
  static constexpr std::size_t kMost = 256;
  using Column = std::array<std::int32_t, kMost + kMostLanes>;

  std::uint64_t* words_;
  int words_per_row_;
  std::size_t size_ = 0;
  Column word_, shift_, bits_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
