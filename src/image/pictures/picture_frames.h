// From a picture file to finite RGBA floats, upright: what OpenImageIO does, and so what is done in a child
// without rights (decode.cpp).
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include <espalier/image/pictures/decode.h>

namespace espalier {

struct PictureFile {
  std::filesystem::path path;
  std::string reader;        ///< as picture_format has it
  std::uintmax_t bytes = 0;  ///< its size
  int orientation = 1;       ///< where the reader tells none
};

/// As decode_picture, but for the palette.
DecodedPicture read_frame(const PictureFile& file, int frame);

}  // namespace espalier
