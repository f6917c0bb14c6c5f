// Measures of how alike two silhouettes are, and weighted sums of them for a search to minimise.
// All are plain functions of a candidate mask `a` and a target mask `b` of the same size (checked:
// InternalError), give values in [0, 1], and are symmetric in a and b, but for gap_iou. They count bits word
// by word. |m| is the number of set pixels of m. A measure of two empty masks is that of identical ones.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/image/masks/mask.h>

namespace espalier {

/// Share of all pixels on which the masks agree: 1 - |a xor b| / (width·height). Two empty masks: 1.
double pixel_accuracy(const Mask& a, const Mask& b);

/// Intersection over union, |a and b| / |a or b|. Two empty masks: 1; one empty: 0.
double iou(const Mask& a, const Mask& b);

/// 2|a and b| / (|a| + |b|). Two empty masks: 1; one empty: 0.
double dice(const Mask& a, const Mask& b);

/// IoU of soft coverage: with a_B, b_B the numbers of set pixels in each 8×8 block B,
/// sum_B min(a_B, b_B) / sum_B max(a_B, b_B). Blind to where in its block a leaf lies.
/// Two empty masks: 1; one empty: 0.
double tolerant_iou(const Mask& a, const Mask& b);

/// IoU of the outlines (outline_of) of both masks. Two empty masks: 1; one empty: 0.
double outline_iou(const Mask& a, const Mask& b);

/// IoU of the gaps: of the pixels inside of `target`'s outline that a mask leaves unset. The only measure
/// that is not symmetric. Filling the outline scores 0 where the target has gaps. No gaps in both: 1.
double gap_iou(const Mask& candidate, const Mask& target);

/// Symmetric truncated distance with K = distance_limit_px(size):
/// (mean over set p of a of min(d(p, b), K) + mean over set q of b of min(d(q, a), K)) / 2K.
/// d is the octagonal distance: the number of dilations, a plus-shaped and a 3×3 one in turn, that
/// take one set to the pixel (within 12 % of the Euclidean distance for K = 16).
/// 0 is best. Two empty masks: 0; one empty: 1.
double truncated_distance(const Mask& a, const Mask& b);

/// K of truncated_distance for pictures whose larger side is `size_px`: size/16, at least 1.
int distance_limit_px(int size_px);

/// `mask` closed with a disc of radius max(width, height)/64 (at least 1 px), holes filled.
Mask outline_of(const Mask& mask);

struct MaskMetrics {
  double pixel_accuracy = 0, iou = 0, dice = 0, tolerant_iou = 0, outline_iou = 0, truncated_distance = 0,
         gap_iou = 0;
};

MaskMetrics compare_masks(const Mask& a, const Mask& b);

/// The target's side of every measure, made once. Immutable, so threads may share it.
class PreparedTarget {
 public:
  explicit PreparedTarget(Mask target);

  const Mask& mask() const { return mask_; }
  const Mask& outline() const { return outline_; }
  const Mask& gaps() const { return gaps_; }  ///< of the outline, what the mask leaves free
  std::size_t set_pixels() const { return set_pixels_; }
  /// Set pixels in each 8×8 block, rows of blocks from the top.
  const std::vector<std::uint8_t>& block_counts() const { return block_counts_; }
  /// Bit j of min(d(p, target), K) for each pixel p.
  const std::vector<Mask>& distance_bits() const { return distance_bits_; }

 private:
  Mask mask_, outline_, gaps_;
  std::size_t set_pixels_ = 0;
  std::vector<std::uint8_t> block_counts_;
  std::vector<Mask> distance_bits_;
};

/// All metrics against a prepared target: the same values as compare_masks.
MaskMetrics compare_masks(const Mask& candidate, const PreparedTarget& target);

struct ObjectiveTerm {
  std::string name;  ///< one of objective_names()
  double weight = 1;
};

/// A weighted sum of dissimilarities; the weights sum to 1.
struct MaskObjective {
  std::vector<ObjectiveTerm> terms;
};

/// What a term can be: pixel_difference, pixel_accuracy, iou, dice, tolerant_iou, outline_iou,
/// gap_iou, truncated_distance. pixel_difference is 1 - pixel_accuracy, whose inverse is the fitness of the
/// dissertation (Weber–Penn fitting, §3.3.2); as a term it equals pixel_accuracy.
std::vector<std::string> objective_names();

/// Reads "iou", or a sum of weighted terms: "0.5*truncated_distance+0.5*iou". Weights are scaled to
/// sum 1. Throws InputError for unknown names and for weights that are not positive and finite.
MaskObjective parse_objective(std::string_view text);

/// The text that parse_objective reads back.
std::string to_string(const MaskObjective& objective);

/// In [0, 1], 0 is best. A similarity s enters as 1 - s, truncated_distance as it is.
double dissimilarity(const MaskObjective& objective, const Mask& candidate, const PreparedTarget& target);
double dissimilarity(const MaskObjective& objective, const Mask& candidate, const Mask& target);

}  // namespace espalier
