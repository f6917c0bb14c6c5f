#include <algorithm>
#include <cmath>

#include <espalier/image/marks/lines.h>

namespace espalier {

namespace {

constexpr double kLeastRow = 0.25, kLeastColumn = 0.5;  ///< of the picture's width, of its height
constexpr double kMostThickness = 1.0 / 120;            ///< of the picture's larger side
constexpr int kLeastThickness = 3;
constexpr double kThinShare = 0.7;  ///< of a line's length, as thin as lines are
constexpr int kReachPx = 4;         ///< between the end of a line and what it ends at

Mask transposed(const Mask& mask) {
  Mask result(mask.height_px(), mask.width_px());
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      if (mask.get(x, y)) result.set(y, x);
  return result;
}

/// The set pixels above and below one, without a gap.
struct Segment {
  int top, bottom;  ///< ends exclusive
  int thickness() const { return bottom - top; }
};

Segment segment_at(const Mask& mask, int x, int y, int most) {
  Segment segment{y, y + 1};
  while (segment.top > 0 && segment.thickness() <= most && mask.get(x, segment.top - 1)) --segment.top;
  while (segment.bottom < mask.height_px() && segment.thickness() <= most && mask.get(x, segment.bottom))
    ++segment.bottom;
  return segment;
}

/// Marks the thin pixels of the run [begin, end) of row y where it is a line; its box is empty where it is
/// none.
MaskBox mark_line(const Mask& mask, int y, int begin, int end, int most_thickness, Mask& lines) {
  std::vector<std::pair<int, Segment>> thin;
  for (int x = begin; x < end; ++x) {
    const Segment segment = segment_at(mask, x, y, most_thickness);
    if (segment.thickness() <= most_thickness) thin.emplace_back(x, segment);
  }
  if (static_cast<double>(thin.size()) < kThinShare * (end - begin)) return {};
  MaskBox box{begin, end, y, y + 1};
  for (const auto& [x, segment] : thin)
    for (int row = segment.top; row < segment.bottom; ++row) {
      lines.set(x, row);
      box.top = std::min(box.top, row), box.bottom = std::max(box.bottom, row + 1);
    }
  return box;
}

/// A line is found in each of its rows once.
void add_line(const MaskBox& line, std::vector<MaskBox>& lines) {
  for (MaskBox& known : lines)
    if (line.top <= known.bottom && known.top <= line.bottom && line.left <= known.right &&
        known.left <= line.right) {
      known = joined(known, line);
      return;
    }
  lines.push_back(line);
}

std::vector<MaskBox> mark_rows(const Mask& mask, int least_length, Mask& lines) {
  const int most_thickness =
      std::max(kLeastThickness,
               static_cast<int>(std::lround(kMostThickness * std::max(mask.width_px(), mask.height_px()))));
  std::vector<MaskBox> found;
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x) {
      if (!mask.get(x, y)) continue;
      const int begin = x;
      while (x < mask.width_px() && mask.get(x, y)) ++x;
      if (x - begin < least_length) continue;
      const MaskBox line = mark_line(mask, y, begin, x, most_thickness, lines);
      if (!line.is_empty()) add_line(line, found);
    }
  return found;
}

/// Whether a vertical line ends, above or below, at a horizontal one or at the picture's edge.
bool ends_somewhere(const MaskBox& column, const std::vector<MaskBox>& rows, int y, int height_px) {
  if (y <= kReachPx || y >= height_px - kReachPx) return true;
  return std::any_of(rows.begin(), rows.end(), [&](const MaskBox& row) {
    return y >= row.top - kReachPx && y <= row.bottom + kReachPx && column.right >= row.left - kReachPx &&
           column.left <= row.right + kReachPx;
  });
}

/// A corner of a frame is as thick as the other line is long, along either.
void mark_crossing(const Mask& mask, const MaskBox& column, const MaskBox& row, Mask& lines) {
  for (int y = row.top; y < row.bottom; ++y)
    for (int x = column.left; x < column.right; ++x)
      if (mask.get(x, y)) lines.set(x, y);
}

}  // namespace

FoundLines find_lines(const Mask& mask) {
  FoundLines found{.pixels = Mask(mask.width_px(), mask.height_px())};
  found.rows = mark_rows(mask, static_cast<int>(kLeastRow * mask.width_px()), found.pixels);
  const Mask turned = transposed(mask);
  Mask column_pixels(turned.width_px(), turned.height_px());
  for (const MaskBox& line :
       mark_rows(turned, static_cast<int>(kLeastColumn * mask.height_px()), column_pixels)) {
    const MaskBox column{line.top, line.bottom, line.left, line.right};
    if (!ends_somewhere(column, found.rows, column.top, mask.height_px()) ||
        !ends_somewhere(column, found.rows, column.bottom, mask.height_px()))
      continue;
    found.columns.push_back(column);
    for (int y = column.top; y < column.bottom; ++y)
      for (int x = column.left; x < column.right; ++x)
        if (column_pixels.get(y, x)) found.pixels.set(x, y);
  }
  for (const MaskBox& column : found.columns)
    for (const MaskBox& row : found.rows) mark_crossing(mask, column, row, found.pixels);
  return found;
}

}  // namespace espalier
