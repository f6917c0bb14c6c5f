// The table of measures of how alike two silhouettes are. From its rows come the array of measures, the terms
// of an objective, the columns of tables, the keys of JSON files, help texts and docs/measures.md. To add a
// measure, write its function in a file of this folder, and declare it and give it a row here.
// A measure compares a candidate with a target of the same size, has values in [0, 1], and counts bits word
// by word. |m| is the number of set pixels of m. Two empty masks have the value of identical ones.
#pragma once
#include <array>
#include <cstddef>
#include <iterator>
#include <string_view>

#include <espalier/image/masks/mask.h>

namespace espalier {

class PreparedTarget;

/// Numbers of pixels from which the plain measures follow.
struct PixelCounts {
  std::size_t all = 0, in_candidate = 0, in_target = 0, in_both = 0;
};

/// What a measure looks at.
struct Comparison {
  const Mask& candidate;
  const PreparedTarget& target;
  PixelCounts pixels;
};

/// Share of all pixels on which the masks agree: 1 - |a xor b| / (width·height). Two empty masks: 1.
double pixel_accuracy(const Comparison& pair);

/// Intersection over union, |a and b| / |a or b|. Two empty masks: 1; one empty: 0.
double iou(const Comparison& pair);

/// 2|a and b| / (|a| + |b|). Two empty masks: 1; one empty: 0.
double dice(const Comparison& pair);

/// IoU of soft coverage: with a_B, b_B the numbers of set pixels in each 8×8 block B,
/// sum_B min(a_B, b_B) / sum_B max(a_B, b_B). Blind to where in its block a leaf lies.
/// Two empty masks: 1; one empty: 0.
double tolerant_iou(const Comparison& pair);

/// IoU of the outlines (outline_of) of both masks. Two empty masks: 1; one empty: 0.
double outline_iou(const Comparison& pair);

/// IoU of the gaps: of the pixels inside of the target's outline that a mask leaves unset. It is not
/// symmetric. Filling the outline scores 0 where the target has gaps. No gaps in both: 1.
double gap_iou(const Comparison& pair);

/// Symmetric truncated distance with K = distance_limit_px(size):
/// (mean over set p of a of min(d(p, b), K) + mean over set q of b of min(d(q, a), K)) / 2K.
/// d is the octagonal distance: the number of dilations, a plus-shaped and a 3×3 one in turn, that
/// take one set to the pixel (within 12 % of the Euclidean distance for K = 16).
/// 0 is best. Two empty masks: 0; one empty: 1.
double truncated_distance(const Comparison& pair);

/// Which end of a measure is that of identical masks: 1, or 0.
enum class Better { larger, smaller };

struct Metric {
  const char* name;
  double (*evaluate)(const Comparison&);
  Better better;
  bool in_objective;        ///< whether an objective may be made of it; else it is only reported
  const char* also_called;  ///< another name that objectives may give it, or nullptr
  const char* help;         ///< one line
};

/// In the order of columns and keys.
inline constexpr Metric kMetrics[] = {
    // pixel_difference is 1 - pixel_accuracy, whose inverse is the fitness of C. Hewitt's
    // dissertation, 3.3.2.
    {"pixel_accuracy", pixel_accuracy, Better::larger, true, "pixel_difference",
     "share of all pixels on which both agree"},
    {"iou", iou, Better::larger, true, nullptr, "intersection over union"},
    {"dice", dice, Better::larger, true, nullptr, "twice the intersection over the sum of both areas"},
    {"tolerant_iou", tolerant_iou, Better::larger, true, nullptr,
     "IoU of the numbers of set pixels in blocks of 8 × 8, blind to where in its block a leaf lies"},
    {"outline_iou", outline_iou, Better::larger, true, nullptr,
     "IoU of the outlines: closed with a disc of 1/64 of the picture, holes filled"},
    {"gap_iou", gap_iou, Better::larger, true, nullptr,
     "IoU of what the masks leave free within the target's outline"},
    {"truncated_distance", truncated_distance, Better::smaller, true, nullptr,
     "mean distance from each mask to the other, cut at 1/16 of the picture, as a share of that"},
};

inline constexpr std::size_t kMetricCount = std::size(kMetrics);

/// A measure by a name that is looked up by the compiler: metrics["iou"]. Without such a row it does not
/// compile.
struct MetricName {
  std::size_t row = 0;

  consteval MetricName(const char* name) {
    while (std::string_view(kMetrics[row].name) != name)
      if (++row == kMetricCount) throw "no row of kMetrics has this name";
  }
};

/// The values of all measures of one comparison.
struct MaskMetrics {
  std::array<double, kMetricCount> values{};  ///< in the order of kMetrics; not a number: not known

  double operator[](MetricName name) const { return values[name.row]; }
  double& operator[](MetricName name) { return values[name.row]; }
};

/// In [0, 1], 0 is best.
constexpr double dissimilarity_of(const Metric& metric, double value) {
  return metric.better == Better::larger ? 1 - value : value;
}

}  // namespace espalier
