// The square frame in which targets and candidates meet: the tree's base at the horizontal middle,
// on a fixed row near the bottom; its scale such that it fills the frame. Lengths in pixels.
#pragma once
#include <espalier/image/masks/mask.h>

namespace espalier {

/// Row position (y, from the top) of the tree's base in a square frame of `size_px`.
constexpr float base_row_px(int size_px) { return static_cast<float>(size_px) * (1 - 1.0f / 32); }

/// A framed tree is this tall or has this half width, as shares of the frame, whichever is tighter.
inline constexpr float kFramedHeight = 0.92f;
inline constexpr float kFramedHalfWidth = 0.48f;

inline constexpr int kMinFrameSize = 16, kMaxFrameSize = 4096;

/// Throws InputError outside kMinFrameSize..kMaxFrameSize.
void check_frame_size(int size_px);

/// The part of a picture that the frame shows: where the tree stands, in its pixels, and how large it
/// becomes.
struct Framing {
  double foot_x = 0, foot_y = 0, frame_px_per_px = 1;
  int size_px = 0;
};

/// Of a mask that holds a tree.
Framing framing_of(const Mask& mask, int size_px);

/// What is set in `mask`, in the frame. Its pixels are blocks of px_per_block of those that the framing
/// knows.
Mask place(const Mask& mask, const Framing& framing, int px_per_block = 1);

}  // namespace espalier
