// What OpenImageIO does not tell of a file: the palette of a PNG, the orientation of a WebP.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace espalier {

/// Colours of a PNG by their numbers (PNG specification, §11.2.2); empty for other files.
std::vector<std::array<std::uint8_t, 3>> png_palette(std::string_view bytes);

/// EXIF's, 1 to 8, of a WebP file (RFC 9649, §2.7.1.5); 1 for other files and where it says none.
int webp_orientation(std::string_view bytes);

}  // namespace espalier
