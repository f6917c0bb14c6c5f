// Comparing two silhouettes of the same size (checked: InternalError): by all measures of the table, or by
// one. See metric_table.h for what each measure is, and objective.h for weighted sums of them.
#pragma once
#include <espalier/image/masks/mask.h>
#include <espalier/image/measures/metric_table.h>
#include <espalier/image/measures/prepared_target.h>

namespace espalier {

/// All measures. A target that is compared often is prepared once; the values are the same.
MaskMetrics compare_masks(const Mask& candidate, const PreparedTarget& target);
MaskMetrics compare_masks(const Mask& candidate, const Mask& target);

// Single measures of masks that are not prepared. All but gap_iou are symmetric.
double pixel_accuracy(const Mask& a, const Mask& b);
double iou(const Mask& a, const Mask& b);
double dice(const Mask& a, const Mask& b);
double tolerant_iou(const Mask& a, const Mask& b);
double outline_iou(const Mask& a, const Mask& b);
double gap_iou(const Mask& candidate, const Mask& target);
double truncated_distance(const Mask& a, const Mask& b);

/// What measures look at, of masks that must outlive it.
Comparison make_comparison(const Mask& candidate, const PreparedTarget& target);

/// K of truncated_distance for pictures whose larger side is `size_px`: size/16, at least 1.
int distance_limit_px(int size_px);

/// `mask` closed with a disc of radius max(width, height)/64 (at least 1 px), holes filled.
Mask outline_of(const Mask& mask);

}  // namespace espalier
