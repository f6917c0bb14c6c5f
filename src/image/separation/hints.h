// What a user says of a picture, as words: colours, places, a part of it. All throw InputError: got,
// expected.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/image/pictures/decode.h>
#include <espalier/image/separation/separation_options.h>

namespace espalier {

/// Red, green and blue as one number, of "1a2b3c"; a "#" before it may be there, though a shell takes it for
/// a comment.
std::optional<std::uint32_t> parse_hex_color(std::string_view text);
/// "1a2b3c", or "R,G,B" of 0 to 255.
ColorValue parse_hinted_color(const std::string& text);
/// "LEFT,TOP,WIDTH,HEIGHT".
PixelBox parse_region(const std::string& text);
/// "X,Y", or several: "X,Y;X,Y".
std::vector<PixelPlace> parse_places(const std::string& text);

/// Throws InputError (opening with `name`) where places lie outside of the picture or the region, or where
/// options contradict each other. Returns the options with places in pixels as decoded.
SeparationOptions fitted_to(const SeparationOptions& options, const DecodedPicture& picture,
                            const std::string& name);

}  // namespace espalier
