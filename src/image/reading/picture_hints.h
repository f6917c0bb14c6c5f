// What a user says of a picture beyond how it is separated, in the words that command lines and files have.
#pragma once
#include <string>

#include <espalier/image/marks/marks.h>
#include <espalier/image/separation/separation_options.h>

namespace espalier {

struct PictureHints {
  double threshold = kHalfCovered;       ///< share of a pixel that the tree covers, from which it is tree
  std::string ground_color, tree_color;  ///< RRGGBB or R,G,B
  std::string region;                    ///< LEFT,TOP,WIDTH,HEIGHT
  std::string tree_seeds, ground_seeds;  ///< X,Y;X,Y
  std::string label;                     ///< numbers or RRGGBB, with commas between
  std::string keep_marks = "none";       ///< none, all, or of strips, lines, captions, figures
  std::string scale_bar;                 ///< PIXELS=METRES
  int tree = 0;                          ///< of several, counted from 1 as one reads; 0: none is chosen
  int frame = 0;                         ///< of an animation, counted from 1; 0: the first that is not blank
};

/// These, with what the hints say. Throws InputError: got, expected.
SeparationOptions with_hints(SeparationOptions options, const PictureHints& hints);

MarkChoice marks_to_leave_out(const std::string& keep_marks);

/// Metres of a pixel of the picture; 0 where nothing is said.
double parse_scale_bar(const std::string& text);

}  // namespace espalier
