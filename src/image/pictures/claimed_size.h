// The size that the header of a picture claims: known before a reader, which may believe it, allocates
// anything, and what time and memory its decoding may take. Only as much of each format is read as that
// needs.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace espalier {

struct ClaimedSize {
  double width_px = 0, height_px = 0;
};

/// `format` as picture_format has it. The largest where there are several pictures (pages, parts, tiles of
/// HEIC). Nothing where the bytes, the first ones of a file, do not say.
std::optional<ClaimedSize> claimed_size(std::string_view bytes, const std::string& format);

}  // namespace espalier
