// A blend strip: the trees from one plant to another in even steps of t, and how evenly their silhouettes
// change.
#pragma once
#include <vector>

#include <espalier/fitting/species_space/blend.h>
#include <espalier/image/masks/mask.h>
#include <espalier/plant/model.h>

namespace espalier {

/// `steps` + 1 plants, t = 0, 1/steps, … 1. steps from 1.
std::vector<ParameterValues> blend_strip(const Model& model, const Encoding& encoding,
                                         const ParameterValues& a, const ParameterValues& b, int steps);

struct StripView {
  int size_px = 128;  ///< of the square pictures
  int seeds = 4;      ///< trees grown for each plant, with seeds 1, 2, …
};

/// The change from each plant to the next: pixels that differ as a share of the picture, the mean over the
/// seeds. Each end is framed to fill the picture, and the frames between them zoom evenly. Plants that do not
/// grow within the default budget are empty pictures. Parallel over plants and seeds; the same bits for any
/// number of threads.
std::vector<double> silhouette_changes(const Model& model, const std::vector<ParameterValues>& strip,
                                       const StripView& view = {});

struct StripEvenness {
  double median = 0, largest = 0;
  int largest_step = 0;  ///< from 0
  /// 1 is perfectly even; 1 too where nothing changes at all.
  double ratio() const { return largest > 0 ? largest / median : 1; }
};

/// changes: at least one.
StripEvenness strip_evenness(const std::vector<double>& changes);

}  // namespace espalier
