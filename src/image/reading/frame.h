// The square frame in which targets and candidates meet: the tree's base at the horizontal middle,
// on a fixed row near the bottom; its scale such that it fills the frame. Lengths in pixels.
#pragma once

namespace espalier {

/// Row position (y, from the top) of the tree's base in a square frame of `size_px`.
constexpr float base_row_px(int size_px) { return static_cast<float>(size_px) * (1 - 1.0f / 32); }

/// A framed tree is this tall or has this half width, as shares of the frame, whichever is tighter.
inline constexpr float kFramedHeight = 0.92f;
inline constexpr float kFramedHalfWidth = 0.48f;

inline constexpr int kMinFrameSize = 16, kMaxFrameSize = 4096;

/// Throws InputError outside kMinFrameSize..kMaxFrameSize.
void check_frame_size(int size_px);

}  // namespace espalier
