#include <algorithm>
#include <cmath>

#include <espalier/environment/picture_field.h>
#include <espalier/image/pictures/decode.h>

namespace espalier {

double PictureField::at(double x_px, double y_px) const {
  const double x = std::clamp(x_px - 0.5, 0.0, width_px - 1.0),
               y = std::clamp(y_px - 0.5, 0.0, height_px - 1.0);
  const int x_0 = static_cast<int>(x), y_0 = static_cast<int>(y);
  const int x_1 = std::min(x_0 + 1, width_px - 1), y_1 = std::min(y_0 + 1, height_px - 1);
  const auto pixel = [&](int i, int j) {
    return double{values[static_cast<std::size_t>(j) * static_cast<std::size_t>(width_px) +
                         static_cast<std::size_t>(i)]};
  };
  return std::lerp(std::lerp(pixel(x_0, y_0), pixel(x_1, y_0), x - x_0),
                   std::lerp(pixel(x_0, y_1), pixel(x_1, y_1), x - x_0), y - y_0);
}

PictureField read_picture_field(const std::filesystem::path& path) {
  const DecodedPicture picture = decode_picture(path);
  PictureField field{picture.width_px, picture.height_px, {}};
  for (const Rgba& c : picture.pixels)
    field.values.push_back(std::clamp(0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2], 0.f, 1.f));
  return field;
}

}  // namespace espalier
