// What the markers of a JPEG file say before it is decoded (ITU-T T.81, annex B): whether it was cut off,
// which the decoder only warns of, painting the missing part in a grey that would pass for background; and
// how often it goes over its pixels: a progressive JPEG of ten thousand bytes may do it a thousand times.
#pragma once
#include <cstddef>
#include <string_view>

namespace espalier {

bool is_jpeg(std::string_view bytes);

/// Whether a JPEG has no end marker (FF D9) after its first scan header; it cannot occur inside coded data.
bool is_jpeg_without_end(std::string_view bytes);

/// How many scans a JPEG has up to its end.
std::size_t count_jpeg_scans(std::string_view bytes);

/// Where a JPEG's frame header is, which holds its size (its marker is FF C0 to FF CF); npos where none is.
std::size_t find_jpeg_frame(std::string_view bytes);

}  // namespace espalier
