// Bounds of what is decoded, checked before anything is allocated for pixels.
#pragma once
#include <cstdint>
#include <filesystem>

namespace espalier {

/// Deflate packs at most 8 · 1032 pixels of one bit into a byte.
inline constexpr double kMaxPixelsPerByte = 10'000;

/// Throws InputError for more than kMaxSourcePixels, layers, sides below kMinSourceSide, and more pixels than
/// a file of `bytes` can hold of a tree.
void check_picture_size(const std::filesystem::path& path, std::uintmax_t bytes, double width_px,
                        double height_px, int layers = 1);

}  // namespace espalier
