// All instruction sets of this machine count the same pixels and distances, the scalar one included.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <espalier/image/measures/compare.h>

#include "support/only_target.h"
#include "support/random_masks.h"

namespace espalier {
namespace {

RC_GTEST_PROP(VectorTargetsOfMasks, AllGiveTheSameBits, ()) {
  const auto [a, b] = test::draw_pair(300);
  const double distance = truncated_distance(a, b), overlap = iou(a, b);
  const std::size_t differing = differing_px(a, b);
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    const OnlyTarget only(left & -left);
    RC_ASSERT(truncated_distance(a, b) == distance);
    RC_ASSERT(iou(a, b) == overlap);
    RC_ASSERT(differing_px(a, b) == differing);
  }
}

}  // namespace
}  // namespace espalier
