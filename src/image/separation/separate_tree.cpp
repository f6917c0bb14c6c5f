#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/separation/border_strips.h>
#include <espalier/image/separation/by_alpha.h>
#include <espalier/image/separation/by_ground.h>
#include <espalier/image/separation/by_luminance.h>
#include <espalier/image/separation/hints.h>
#include <espalier/image/separation/labels.h>
#include <espalier/image/separation/separate_tree.h>

namespace espalier {

namespace {

constexpr float kSmallestContrast = 0.02f;  ///< between the tones of tree and background, of the range 0..1

constexpr float kColored = 0.1f;        ///< difference of the channels of a pixel that is not grey
constexpr double kMostColored = 0.005;  ///< of the pixels of a grey picture

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

/// But for a few pixels, as of a stamp or of JPEG's noise.
bool is_almost_grey(const DecodedPicture& picture) {
  const auto colored = std::count_if(picture.pixels.begin(), picture.pixels.end(), [](const Rgba& pixel) {
    return std::max({pixel[0], pixel[1], pixel[2]}) - std::min({pixel[0], pixel[1], pixel[2]}) > kColored;
  });
  return static_cast<double>(colored) < kMostColored * static_cast<double>(picture.pixels.size());
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

/// What is set within the box alone.
Mask box_mask(const DecodedPicture& picture, const PixelBox& box) {
  Mask mask(picture.width_px, picture.height_px);
  for (int y = box.top; y < box.top + box.height; ++y)
    for (int x = box.left; x < box.left + box.width; ++x) mask.set(x, y);
  return mask;
}

Mask whole_part(const DecodedPicture& picture, const SeparationOptions& options) {
  return box_mask(picture, options.region.value_or(PixelBox{0, 0, picture.width_px, picture.height_px}));
}

/// The part of the picture that counts, and what is left out.
struct Shown {
  Mask part;
  std::vector<std::string> left_out;
};

Shown shown_part(const DecodedPicture& picture, const AlphaReading& alpha, const SeparationOptions& options) {
  Shown shown{whole_part(picture, options), {}};
  if (alpha.outlines_card) {
    shown.part = both(shown.part, alpha.shown);
    shown.left_out.emplace_back("what is transparent around a sheet: its alpha outlines no tree");
  } else if (!options.region && !options.keep_strips) {
    const BorderStrips strips = find_border_strips(picture);
    if (!strips.any()) return shown;
    shown.part = box_mask(picture, {strips.left, strips.top, picture.width_px - strips.left - strips.right,
                                    picture.height_px - strips.top - strips.bottom});
    shown.left_out.push_back(describe(strips));
  }
  return shown;
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
  const ToneSplit split = split_tones(tones, shown);
  const BorderColors border = border_colors(picture, shown);
  const bool by_tone = options.method == luminance || (options.method == automatic && split.is_two_tone() &&
                                                       is_almost_grey(picture) && !is_hinted(options));
  if (!by_tone) return separate_by_ground(picture, shown, border, options);
  if (split.contrast() < kSmallestContrast)
    throw_input_error("{}: shows no tree: it is of one tone (luminance {:.3f})", name, tones.values[0]);
  return separate_by_luminance(tones, split, shown, options);
}

}  // namespace

Separation separate_tree(const DecodedPicture& picture, const SeparationOptions& asked,
                         const std::string& name) {
  using enum SeparationMethod;
  const SeparationOptions options = fitted_to(asked, picture, name);
  const AlphaReading alpha_reading = read_alpha(picture);
  check_alpha(picture, alpha_reading, options, name);
  const bool may_hold_labels = options.method == automatic && !alpha_reading.informs && !is_hinted(options);
  if (may_hold_labels || !options.label.empty())
    if (auto separation = separate_by_label(picture, options.label, name)) {
      separation->mask = both(separation->mask, whole_part(picture, options));
      return *separation;
    }
  if (options.method == alpha || (options.method == automatic && alpha_reading.informs &&
                                  !alpha_reading.outlines_card && !is_hinted(options))) {
    Separation separation = separate_by_alpha(picture, alpha_reading, options);
    if (options.region) separation.mask = both(separation.mask, whole_part(picture, options));
    return separation;
  }
  const Shown shown = shown_part(picture, alpha_reading, options);
  Separation separation = separate_by_colors(picture, shown.part, options, name);
  separation.left_out = shown.left_out;
  return separation;
}

}  // namespace espalier
