// How the tree of a picture is told from its ground: what a user may say of it. All of it can be left out.
// Places are pixels of the picture as it is seen, upright, from its upper left corner.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <espalier/core/names.h>

namespace espalier {

/// How the tree is told from the background. automatic: labels where the picture holds labels; alpha where it
/// carries information; else luminance (Otsu's threshold) where a grey picture has two tones; else what
/// differs from the ground that the border shows.
enum class SeparationMethod { automatic, alpha, luminance, background };

template <>
inline constexpr auto kNames<SeparationMethod> =
    std::to_array<Name<SeparationMethod>>({{SeparationMethod::automatic, "auto"},
                                           {SeparationMethod::alpha, "alpha"},
                                           {SeparationMethod::luminance, "luminance"},
                                           {SeparationMethod::background, "background"}});

/// Which side of the threshold is the tree. automatic: the one the border does not show.
/// For alpha, light is the opaque side; for background, light is what differs from the border.
enum class TreeSide { automatic, light, dark };

template <>
inline constexpr auto kNames<TreeSide> = std::to_array<Name<TreeSide>>({{TreeSide::automatic, "auto"},
                                                                        {TreeSide::light, "light"},
                                                                        {TreeSide::dark, "dark"}});

inline constexpr float kHalfCovered = 0.5f;

struct PixelPlace {
  int x = 0, y = 0;
};

struct PixelBox {
  int left = 0, top = 0, width = 0, height = 0;
};

using ColorValue = std::array<float, 3>;  ///< red, green, blue, 0..1

struct SeparationOptions {
  SeparationMethod method = SeparationMethod::automatic;
  TreeSide side = TreeSide::automatic;
  float threshold = kHalfCovered;  ///< share of a pixel that the tree covers, from which it is tree
  std::optional<ColorValue> ground_color, tree_color;
  std::optional<PixelBox> region;  ///< the part of the picture that shows the tree
  std::vector<PixelPlace> tree_seeds, ground_seeds;
  std::string label;  ///< of a picture of labels: numbers or RRGGBB, with commas between; empty: the only one
  bool keep_strips = false;  ///< strips along the edges are part of the picture
};

}  // namespace espalier
