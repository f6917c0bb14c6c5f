// The size that the header of a GIF or WebP file claims. Their readers decode, and so allocate, while
// they open a file; a claim must be known before. GIF89a §18; WebP container specification (RFC 9649).
#pragma once
#include <filesystem>
#include <optional>

namespace espalier {

struct ClaimedSize {
  int width_px = 0, height_px = 0;
};

/// Nothing for other formats, and where the header is cut off.
std::optional<ClaimedSize> claimed_size(const std::filesystem::path& path);

}  // namespace espalier
