// Whether a JPEG file was cut off. The decoder only warns and paints the missing part grey, which would
// pass for background. ITU-T T.81, annex B: the end marker FF D9 cannot occur inside coded data.
#pragma once
#include <filesystem>

namespace espalier {

/// True for a file that opens like a JPEG and has no end marker after its first scan header.
bool is_jpeg_without_end(const std::filesystem::path& path);

}  // namespace espalier
