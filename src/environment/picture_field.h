// A picture as a field over the ground: a number from 0 (black, or nothing) to 1 (white) at each place.
#pragma once
#include <filesystem>
#include <vector>

namespace espalier {

struct PictureField {
  int width_px = 0, height_px = 0;
  std::vector<float> values;  ///< row by row from the top

  /// The value is linear between the middles of pixels and, beyond the picture, that of its border. Positions
  /// in pixels.
  double at(double x_px, double y_px) const;
};

/// Luminance (Rec. 709) of what OpenImageIO reads. Throws InputError naming the file.
PictureField read_picture_field(const std::filesystem::path& path);

}  // namespace espalier
