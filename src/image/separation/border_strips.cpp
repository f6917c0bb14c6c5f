#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <espalier/image/separation/border_strips.h>
#include <espalier/image/separation/color_field.h>

namespace espalier {

namespace {

constexpr float kSameColor = 0.09f, kOtherColor = 0.15f;
constexpr double kWholeLine = 0.995;  ///< of a line of the strip, that has its colour: no trunk crosses it
constexpr double kWholeEdge = 0.75;   ///< of the first line behind it, that has another
constexpr double kMostDepth = 0.2;    ///< of the picture
constexpr int kSoftPx = 3;            ///< most that its inner edge is soft
constexpr int kMostStrips = 3;        ///< one behind the other

/// Lines of pixels parallel to one edge, counted from it.
struct Side {
  bool is_row = true, from_end = false;
};

struct Rectangle {
  int left, right, top, bottom;  ///< ends exclusive
};

int depth_of(const Rectangle& rest, const Side& side) {
  return side.is_row ? rest.bottom - rest.top : rest.right - rest.left;
}

std::vector<ColorValue> line_at(const DecodedPicture& picture, const Rectangle& rest, const Side& side,
                                int depth) {
  std::vector<ColorValue> line;
  if (side.is_row) {
    const int y = side.from_end ? rest.bottom - 1 - depth : rest.top + depth;
    for (int x = rest.left; x < rest.right; ++x) line.push_back(color_of(picture.at(x, y)));
  } else {
    const int x = side.from_end ? rest.right - 1 - depth : rest.left + depth;
    for (int y = rest.top; y < rest.bottom; ++y) line.push_back(color_of(picture.at(x, y)));
  }
  return line;
}

ColorValue median_of_line(const std::vector<ColorValue>& line) {
  ColorValue median{};
  std::vector<float> values(line.size());
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < line.size(); ++i) values[i] = line[i][c];
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    median[c] = values[values.size() / 2];
  }
  return median;
}

double share_near(const std::vector<ColorValue>& line, const ColorValue& color, float distance) {
  const auto near = std::count_if(line.begin(), line.end(), [&](const ColorValue& pixel) {
    return color_distance(pixel, color) <= distance;
  });
  return static_cast<double>(near) / static_cast<double>(line.size());
}

/// Depth of the strip at one side; 0 where there is none.
int strip_depth(const DecodedPicture& picture, const Rectangle& rest, const Side& side) {
  const int whole = depth_of(rest, side), most = static_cast<int>(kMostDepth * whole);
  if (whole < 16) return 0;
  const ColorValue color = median_of_line(line_at(picture, rest, side, 0));
  int depth = 0;
  while (depth <= most && share_near(line_at(picture, rest, side, depth), color, kSameColor) >= kWholeLine)
    ++depth;
  if (depth == 0 || depth > most) return 0;
  for (int inner = depth; inner <= depth + kSoftPx; ++inner)
    if (1 - share_near(line_at(picture, rest, side, inner), color, kOtherColor) >= kWholeEdge) {
      // What is soft of the edge is no part of the picture either.
      const ColorValue behind = median_of_line(line_at(picture, rest, side, inner + kSoftPx));
      while (inner < depth + kSoftPx &&
             color_distance(median_of_line(line_at(picture, rest, side, inner)), behind) > kSameColor / 2)
        ++inner;
      return inner;
    }
  return 0;
}

}  // namespace

BorderStrips find_border_strips(const DecodedPicture& picture) {
  BorderStrips strips;
  Rectangle rest{0, picture.width_px, 0, picture.height_px};
  for (int round = 0; round < kMostStrips; ++round) {
    const int top = strip_depth(picture, rest, {true, false});
    rest.top += top;
    const int bottom = strip_depth(picture, rest, {true, true});
    rest.bottom -= bottom;
    const int left = strip_depth(picture, rest, {false, false});
    rest.left += left;
    const int right = strip_depth(picture, rest, {false, true});
    rest.right -= right;
    if (top + bottom + left + right == 0) break;
    strips.top += top, strips.bottom += bottom, strips.left += left, strips.right += right;
  }
  return strips;
}

std::string describe(const BorderStrips& strips) {
  std::vector<std::string> words;
  const auto add = [&](int depth_px, const char* side) {
    if (depth_px > 0) words.push_back(fmt::format("{} px {}", depth_px, side));
  };
  add(strips.left, "left");
  add(strips.right, "right");
  add(strips.top, "above");
  add(strips.bottom, "below");
  return fmt::format("border strips: {}", fmt::join(words, ", "));
}

}  // namespace espalier
