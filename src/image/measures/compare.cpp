#include <algorithm>

#include <espalier/core/error.h>
#include <espalier/image/masks/bits.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/measures/compare.h>
#include <espalier/image/measures/distance.h>

namespace espalier {

namespace {

void check_same_size(const Mask& a, const Mask& b) {
  ESPALIER_CHECK_EQ(a.width_px(), b.width_px());
  ESPALIER_CHECK_EQ(a.height_px(), b.height_px());
}

/// What of the target's outline its mask leaves free.
Mask gaps_of(const Mask& target, const Mask& outline) {
  Mask gaps = outline;
  for (std::size_t i = 0; i < gaps.words().size(); ++i) gaps.words()[i] &= ~target.words()[i];
  return gaps;
}

/// Of masks of one size; the first two are the target's.
double gap_iou(const Mask& outline, const Mask& gaps, const Mask& candidate) {
  const std::size_t in_candidate = count_and_not(outline.words(), candidate.words()),
                    in_both = count_and_not(gaps.words(), candidate.words()),
                    in_any = in_candidate + count_bits(gaps.words()) - in_both;
  return in_any == 0 ? 1 : static_cast<double>(in_both) / static_cast<double>(in_any);
}

PixelCounts count_pixels(const Mask& a, const Mask& b) {
  check_same_size(a, b);
  return {static_cast<std::size_t>(a.width_px()) * a.height_px(), count_bits(a.words()),
          count_bits(b.words()), count_and(a.words(), b.words())};
}

/// part / whole, or `if_nothing` where the whole is 0.
double share(std::size_t part, std::size_t whole, double if_nothing) {
  return whole == 0 ? if_nothing : static_cast<double>(part) / static_cast<double>(whole);
}

double pixel_accuracy(const PixelCounts& n) {
  const std::size_t differing = n.in_candidate + n.in_target - 2 * n.in_both;
  return share(n.all - differing, n.all, 1);
}
double iou(const PixelCounts& n) { return share(n.in_both, n.in_candidate + n.in_target - n.in_both, 1); }
double dice(const PixelCounts& n) { return share(2 * n.in_both, n.in_candidate + n.in_target, 1); }

/// Set pixels of each 8×8 block. Eight counts, each at most 64, are summed in the bytes of one word.
std::vector<std::uint8_t> count_blocks(const Mask& mask) {
  const int block_rows = (mask.height_px() + 7) / 8, words = mask.words_per_row();
  std::vector<std::uint8_t> counts;
  counts.reserve(static_cast<std::size_t>(block_rows) * words * 8);
  for (int block_y = 0; block_y < block_rows; ++block_y) {
    const int end_y = std::min(8 * block_y + 8, mask.height_px());
    for (int i = 0; i < words; ++i) {
      std::uint64_t bytes = 0;
      for (int y = 8 * block_y; y < end_y; ++y) bytes += bits_of_bytes(mask.row(y)[i]);
      for (int block = 0; block < 8; ++block) counts.push_back(static_cast<std::uint8_t>(bytes >> 8 * block));
    }
  }
  return counts;
}

double block_iou(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  std::uint32_t shared = 0, covered = 0;  // at most 64 a block: 4096² px stay below 2^25
  for (std::size_t i = 0; i < a.size(); ++i) {
    shared += std::min(a[i], b[i]);
    covered += std::max(a[i], b[i]);
  }
  return share(shared, covered, 1);
}

int larger_side_px(const Mask& mask) { return std::max(mask.width_px(), mask.height_px()); }

/// (sum over a / |a| + sum over b / |b|) / 2K
double truncated_distance(const PixelCounts& n, std::size_t sum_over_a_px, std::size_t sum_over_b_px,
                          int limit_px) {
  if (n.in_candidate == 0 && n.in_target == 0) return 0;
  if (n.in_candidate == 0 || n.in_target == 0) return 1;
  return (share(sum_over_a_px, n.in_candidate, 0) + share(sum_over_b_px, n.in_target, 0)) / (2.0 * limit_px);
}

}  // namespace

double pixel_accuracy(const Comparison& pair) { return pixel_accuracy(pair.pixels); }
double iou(const Comparison& pair) { return iou(pair.pixels); }
double dice(const Comparison& pair) { return dice(pair.pixels); }

double tolerant_iou(const Comparison& pair) {
  return block_iou(count_blocks(pair.candidate), pair.target.block_counts());
}

double outline_iou(const Comparison& pair) { return iou(outline_of(pair.candidate), pair.target.outline()); }

double gap_iou(const Comparison& pair) {
  return gap_iou(pair.target.outline(), pair.target.gaps(), pair.candidate);
}

double truncated_distance(const Comparison& pair) {
  const int limit_px = distance_limit_px(larger_side_px(pair.candidate));
  return truncated_distance(pair.pixels, sum_distances_px(pair.candidate, pair.target.distance_bits()),
                            sum_distances_px(pair.target.mask(), pair.candidate, limit_px), limit_px);
}

double pixel_accuracy(const Mask& a, const Mask& b) { return pixel_accuracy(count_pixels(a, b)); }
double iou(const Mask& a, const Mask& b) { return iou(count_pixels(a, b)); }
double dice(const Mask& a, const Mask& b) { return dice(count_pixels(a, b)); }

double tolerant_iou(const Mask& a, const Mask& b) {
  check_same_size(a, b);
  return block_iou(count_blocks(a), count_blocks(b));
}

double outline_iou(const Mask& a, const Mask& b) {
  check_same_size(a, b);
  return iou(outline_of(a), outline_of(b));
}

double gap_iou(const Mask& candidate, const Mask& target) {
  check_same_size(candidate, target);
  const Mask outline = outline_of(target);
  return gap_iou(outline, gaps_of(target, outline), candidate);
}

double truncated_distance(const Mask& a, const Mask& b) {
  const PixelCounts n = count_pixels(a, b);
  const int limit_px = distance_limit_px(larger_side_px(a));
  return truncated_distance(n, sum_distances_px(a, b, limit_px), sum_distances_px(b, a, limit_px), limit_px);
}

int distance_limit_px(int size_px) { return std::max(1, size_px / 16); }

Mask outline_of(const Mask& mask) {
  return fill_holes(close_disc(mask, std::max(1, larger_side_px(mask) / 64)));
}

Comparison make_comparison(const Mask& candidate, const PreparedTarget& target) {
  check_same_size(candidate, target.mask());
  return {
      candidate,
      target,
      {static_cast<std::size_t>(candidate.width_px()) * candidate.height_px(), count_bits(candidate.words()),
       target.set_pixels(), count_and(candidate.words(), target.mask().words())}};
}

MaskMetrics compare_masks(const Mask& candidate, const PreparedTarget& target) {
  const Comparison pair = make_comparison(candidate, target);
  MaskMetrics metrics;
  for (std::size_t row = 0; row < kMetricCount; ++row) metrics.values[row] = kMetrics[row].evaluate(pair);
  return metrics;
}

MaskMetrics compare_masks(const Mask& candidate, const Mask& target) {
  return compare_masks(candidate, PreparedTarget(target));
}

PreparedTarget::PreparedTarget(Mask target)
    : mask_(std::move(target)),
      outline_(outline_of(mask_)),
      gaps_(gaps_of(mask_, outline_)),
      set_pixels_(area_px(mask_)),
      block_counts_(count_blocks(mask_)),
      distance_bits_(distance_bit_planes(mask_, distance_limit_px(larger_side_px(mask_)))) {}

}  // namespace espalier
