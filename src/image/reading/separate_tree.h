// Tells the tree from its background: by alpha, by luminance, or by the colour that the border shows.
// Otsu, A threshold selection method from gray-level histograms, IEEE Trans. SMC 9 (1979).
#pragma once
#include <string>
#include <vector>

#include <espalier/image/pictures/decode.h>
#include <espalier/image/reading/read_target.h>

namespace espalier {

struct Separation {
  Mask mask;
  std::string how;  ///< "alpha above 0.5", "luminance below 0.41 (Otsu), the border is light"
};

/// Throws InputError (opening with `name`) where the picture has one tone only, or has no alpha and
/// `method` asks for it.
Separation separate_tree(const DecodedPicture& picture, SeparationMethod method, TreeSide side,
                         const std::string& name);

/// Otsu's threshold: of all thresholds between bins of `histogram`, the first that maximises the variance
/// between the classes. Returns the last bin of the lower class; in the middle where several are best.
int otsu_threshold(const std::vector<std::size_t>& histogram);

}  // namespace espalier
