// A picture of a tree becomes the mask that a fit sees: decode (OpenImageIO), separate tree from
// background, clean, place in the frame of image/reading/frame.h.
// Lengths in pixels: of the frame, or "source px" for those of the picture file.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <espalier/core/names.h>
#include <espalier/image/masks/mask.h>
#include <espalier/image/reading/frame.h>
#include <espalier/image/reading/picture_faults.h>
#include <espalier/image/reading/picture_hints.h>
#include <espalier/image/reading/plant_labels.h>
#include <espalier/image/separation/separation_options.h>

namespace espalier {

/// Whether leaves and wood are told apart by their colours [plant_labels.h].
enum class LabelChoice { automatic, none };

template <>
inline constexpr auto kNames<LabelChoice> =
    std::to_array<Name<LabelChoice>>({{LabelChoice::automatic, "auto"}, {LabelChoice::none, "none"}});

struct TargetOptions {
  int size_px = 256;  ///< side of the square frame, 16..4096
  SeparationOptions separation;
  PictureHints hints;
  int speck_px = -1;           ///< pieces of the source smaller than this are dropped; -1: chosen by size
  bool fill_pinholes = false;  ///< fill holes smaller than speck_px
  bool one_tree = false;       ///< of several trees in a picture, the largest; else all as one
  LabelChoice labels = LabelChoice::none;
};

struct TargetPicture {
  Mask mask;                 ///< size_px × size_px
  float tree_height_px = 0;  ///< from the top of the tree to its base, in the frame
  float frame_px_per_source_px = 1;
  int source_width_px = 0, source_height_px = 0;
  std::string how;                    ///< one line: how the mask was made
  double confidence = 1;              ///< share of what stands out that is clearly tree or clearly ground
  std::vector<std::string> warnings;  ///< of the separation, a line each
  std::vector<std::string> left_out;  ///< what of the picture is no tree, a line each
  std::optional<double> height_m;     ///< of the tree, where a scale bar tells it
  Mask source_tree,
      source_marks;      ///< in the picture's own place: what is fitted, and what was left out of it
  PictureFaults faults;  ///< of the picture; only read_target looks for them
  PlantLabels labels;    ///< of the mask's size and within it; only of read_target, where they are asked for
};

/// Throws InputError (one line, naming the file) for what is no readable picture, claims more than
/// 100 Mpx, holds NaN, or shows no tree; and where options contradict each other or the picture.
TargetPicture read_target(const std::filesystem::path& path, const TargetOptions& options = {});

/// Only separated and cleaned, in the picture's own size and place.
TargetPicture read_mask(const std::filesystem::path& path, const TargetOptions& options = {});

/// Places a mask that holds a tree in the frame of `size_px`. Throws InputError (opening with `name`)
/// where nothing is set.
TargetPicture frame_mask(const Mask& mask, int size_px, const std::string& name = "mask");

}  // namespace espalier
