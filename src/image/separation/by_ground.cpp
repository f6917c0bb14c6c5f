#include <espalier/core/error.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/separation/by_ground.h>
#include <espalier/image/separation/coverage.h>
#include <espalier/image/separation/ground.h>
#include <espalier/image/separation/mask_parts.h>

namespace espalier {

namespace {

constexpr float kRounding = 1.0f / 255;  ///< of colours, to 8 bits: half covered pixels are tree
constexpr float kDoubt = 0.2f;           ///< a pixel within this of the threshold may be of either side
constexpr double kDoubtfulBorder = 0.6;  ///< of the border, that is like the ground beside it

/// The share of all that stands out that is clearly of one side.
double clear_share(const Channel& coverage, float threshold) {
  double all = 0, clear = 0;
  for (const float value : coverage.values) {
    if (value < kDoubt) continue;
    all += 1;
    clear += std::fabs(value - threshold) > kDoubt;
  }
  return all == 0 ? 0 : clear / all;
}

}  // namespace

Separation separate_by_ground(const DecodedPicture& picture, const Mask& shown, const BorderColors& border,
                              const SeparationOptions& options) {
  const Ground ground = find_ground(picture, shown, border, options);
  const Coverage mixture = coverage_of(picture, ground, options.tree_color);
  const Channel& coverage = mixture.share;
  Separation separation;
  const float rounding = mixture.is_soft ? 0 : kRounding;
  separation.mask = both(above(coverage, options.threshold - rounding), shown);
  separation.mask = either(separation.mask, ground.claimed);
  if (options.side == TreeSide::dark) separation.mask = without(shown, separation.mask);
  const auto [red, green, blue] = options.ground_color.value_or(border.color);
  const std::string of_ground =
      border.share > 0.7 || options.ground_color
          ? fmt::format("the ground's colour ({:.2f}, {:.2f}, {:.2f})", red, green, blue)
          : "a ground that varies, grown from the border";
  separation.how = fmt::format("{} {:.2f} by what is not {}",
                               options.side == TreeSide::dark ? "covered less than" : "covered more than",
                               options.threshold, of_ground);
  separation.confidence =
      clear_share(coverage, options.threshold) * std::min(1.0, ground.border_share / kDoubtfulBorder);
  if (ground.border_share < kDoubtfulBorder)
    separation.warnings.push_back(
        fmt::format("only {:.0f} % of the border shows a ground: the mask may be wrong (--region, "
                    "--seed-ground or --ground-color tell it)",
                    100 * ground.border_share));
  return separation;
}

}  // namespace espalier
