// Which formats of pictures are read: those that cameras, scanners, browsers and drawing programs write.
// OpenImageIO has thirty readers, and by itself lets the bytes of a file choose among them, whatever its name
// says: the odd ones have faults that few have looked for.
#pragma once
#include <string>
#include <string_view>

namespace espalier {

/// The name of OpenImageIO's reader of a file that begins with these bytes; empty where it is of no format
/// that is read. TGA files have no signature: `extension` (".tga") and a header that can be one tell them.
std::string picture_format(std::string_view beginning, const std::string& extension);

/// "PNG, JPEG, …", for messages.
inline constexpr const char* kPictureFormats = "PNG, JPEG, GIF, TIFF, WebP, BMP, EXR, HEIC, AVIF, PNM or TGA";

}  // namespace espalier
