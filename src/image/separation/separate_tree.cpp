#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/separation/by_alpha.h>
#include <espalier/image/separation/by_ground.h>
#include <espalier/image/separation/by_luminance.h>
#include <espalier/image/separation/separate_tree.h>

namespace espalier {

namespace {

constexpr float kSmallestContrast = 0.02f;  ///< between the tones of tree and background, of the range 0..1

/// Whether some channel of some two pixels differs visibly.
bool has_contrast(const DecodedPicture& picture) {
  Rgba least = picture.pixels.front(), most = least;
  for (const Rgba& pixel : picture.pixels)
    for (int c = 0; c < 3; ++c) {
      least[c] = std::min(least[c], pixel[c]);
      most[c] = std::max(most[c], pixel[c]);
    }
  return std::max({most[0] - least[0], most[1] - least[1], most[2] - least[2]}) >= kSmallestContrast;
}

void check_alpha(const DecodedPicture& picture, const AlphaReading& alpha, const SeparationOptions& options,
                 const std::string& name) {
  if (options.method == SeparationMethod::alpha && !picture.has_alpha)
    throw_input_error("{}: has no alpha channel, expected one for the method 'alpha'", name);
  if (alpha.is_nothing) throw_input_error("{}: shows no tree: it is transparent everywhere", name);
}

bool is_hinted(const SeparationOptions& options) {
  return options.ground_color || options.tree_color || !options.tree_seeds.empty() ||
         !options.ground_seeds.empty();
}

Mask shown_part(const DecodedPicture& picture, const AlphaReading& alpha) {
  if (alpha.outlines_card) return alpha.shown;
  return complement(Mask(picture.width_px, picture.height_px));
}

Separation separate_by_colors(const DecodedPicture& picture, const Mask& shown,
                              const SeparationOptions& options, const std::string& name) {
  using enum SeparationMethod;
  if (!has_contrast(picture)) {
    const auto [red, green, blue, _] = picture.pixels.front();
    throw_input_error("{}: shows no tree: all of it is of one colour ({:.2f}, {:.2f}, {:.2f})", name, red,
                      green, blue);
  }
  const Channel tones = luminance_of(picture);
  const ToneSplit split = split_tones(tones);
  const BorderColors border = border_colors(picture, shown);
  const bool by_tone = options.method == luminance ||
                       (options.method == automatic && split.is_two_tone() && !is_hinted(options));
  if (!by_tone) return separate_by_ground(picture, shown, border, options);
  if (split.contrast() < kSmallestContrast)
    throw_input_error("{}: shows no tree: it is of one tone (luminance {:.3f})", name, tones.values[0]);
  Separation separation = separate_by_luminance(tones, split, options);
  separation.mask = both(separation.mask, shown);
  return separation;
}

}  // namespace

Separation separate_tree(const DecodedPicture& picture, const SeparationOptions& options,
                         const std::string& name) {
  using enum SeparationMethod;
  const AlphaReading alpha_reading = read_alpha(picture);
  check_alpha(picture, alpha_reading, options, name);
  if (options.method == alpha || (options.method == automatic && alpha_reading.informs &&
                                  !alpha_reading.outlines_card && !is_hinted(options)))
    return separate_by_alpha(picture, alpha_reading, options);
  return separate_by_colors(picture, shown_part(picture, alpha_reading), options, name);
}

}  // namespace espalier
