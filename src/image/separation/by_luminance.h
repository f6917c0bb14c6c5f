// The tree by its tone: darker or lighter than a threshold.
// Otsu, A threshold selection method from gray-level histograms, IEEE Trans. SMC 9 (1979).
#pragma once
#include <vector>

#include <espalier/image/separation/color_field.h>
#include <espalier/image/separation/separation.h>

namespace espalier {

/// A threshold, and the tones on its two sides.
struct ToneSplit {
  float threshold = 0, dark_mean = 0, light_mean = 0;
  double near_a_mean = 0;  ///< share of pixels within a tenth of the contrast of their side's mean

  float contrast() const { return light_mean - dark_mean; }
  /// Two tones, with at most soft edges between them: luminance then tells more exactly where the edge is.
  bool is_two_tone() const { return near_a_mean > 0.85 && contrast() > 0.3f; }
};

Channel luminance_of(const DecodedPicture& picture);

/// Of the pixels that are shown.
ToneSplit split_tones(const Channel& luminance, const Mask& shown);

/// Where a threshold other than one half is asked for, it is that share of the way from the ground's tone to
/// the tree's.
Separation separate_by_luminance(const Channel& luminance, const ToneSplit& split, const Mask& shown,
                                 const SeparationOptions& options);

/// Otsu's threshold: of all thresholds between bins of `histogram`, the first that maximises the variance
/// between the classes. Returns the last bin of the lower class; in the middle where several are best.
int otsu_threshold(const std::vector<std::size_t>& histogram);

}  // namespace espalier
