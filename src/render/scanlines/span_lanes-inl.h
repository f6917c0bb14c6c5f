// Runs of pixels of many shapes at once, for files that Highway compiles once per instruction set.
#if defined(ESPALIER_RENDER_SPAN_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ESPALIER_RENDER_SPAN_LANES_INL_H
#undef ESPALIER_RENDER_SPAN_LANES_INL_H
#else
#define ESPALIER_RENDER_SPAN_LANES_INL_H
#endif

#include <espalier/core/vector_math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

struct RunLanes {
  hn::Vec<hn::RebindToSigned<Floats>> begin, end;
};

/// centres_between [span.h] of each lane. Empty runs, also where bounds are no numbers, are
/// [0, 0).
inline RunLanes run_lanes(Vector low, Vector high, int size) {
  const hn::RebindToSigned<Floats> di;
  const Vector half = set(0.5f), limit = set(static_cast<float>(size));
  const Vector first = hn::Ceil(hn::Min(hn::Max(hn::Sub(low, half), set(0)), limit));
  const Vector last = hn::Floor(hn::Max(hn::Min(hn::Add(high, half), limit), set(0)));
  const auto is_run = hn::And(hn::Le(low, high), hn::Lt(first, last));
  return {hn::ConvertTo(di, hn::IfThenElseZero(is_run, first)),
          hn::ConvertTo(di, hn::IfThenElseZero(is_run, last))};
}

inline void store_run(Vector low, Vector high, int size, std::int32_t* begin, std::int32_t* end) {
  const hn::RebindToSigned<Floats> di;
  const RunLanes run = run_lanes(low, high, size);
  hn::StoreU(run.begin, di, begin);
  hn::StoreU(run.end, di, end);
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#endif
