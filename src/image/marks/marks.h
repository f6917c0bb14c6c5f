// What a picture shows beside its tree: ground lines, frames, captions, scale bars, persons. They would set
// the tree's foot and scale, so they are found in the mask and left out. All in the picture's own pixels.
#pragma once
#include <string>
#include <vector>

#include <espalier/image/masks/mask.h>
#include <espalier/image/masks/mask_box.h>

namespace espalier {

enum class MarkKind { line, frame, caption, scale_bar, figure, piece };

struct Mark {
  MarkKind kind = MarkKind::piece;
  MaskBox box;
  int parts = 1;  ///< letters of a caption, lines of a frame
};

/// Which marks are left out; the others stay.
struct MarkChoice {
  bool lines = true, captions = true, figures = true;
};

struct MarkedMask {
  Mask tree;                ///< what is left
  std::vector<Mark> marks;  ///< that were left out
};

/// A long thin line is taken out of what it touches; what stands apart from the tree, outside of its outline,
/// and is much smaller, is no part of it.
MarkedMask without_marks(const Mask& mask, const MarkChoice& choice);

/// "a scale bar 203 px long, 12 px from the lower edge", a line for all of a kind.
std::vector<std::string> describe(const std::vector<Mark>& marks);

}  // namespace espalier
