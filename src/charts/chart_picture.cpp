// The chart as pixels: strokes by their distance to each pixel centre, labels in a font of 5×7 dots
// drawn at twice its size.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <espalier/charts/chart_layout.h>

namespace espalier {

namespace {

constexpr int kDotPx = 2;             ///< side of a dot of the font
constexpr int kGlyphPx = 6 * kDotPx;  ///< advance
constexpr int kTextHeightPx = 7 * kDotPx;
constexpr Rgb kTextColor{60, 60, 60};

/// Columns from the left, bit 0 at the top.
struct Glyph {
  char letter;
  std::array<std::uint8_t, 5> columns;
};

// clang-format off
constexpr Glyph kGlyphs[] = {
    {'(', {0x00, 0x1C, 0x22, 0x41, 0x00}}, {')', {0x00, 0x41, 0x22, 0x1C, 0x00}},
    {'+', {0x08, 0x08, 0x3E, 0x08, 0x08}}, {'-', {0x08, 0x08, 0x08, 0x08, 0x08}},
    {'.', {0x00, 0x60, 0x60, 0x00, 0x00}}, {',', {0x00, 0x50, 0x30, 0x00, 0x00}},
    {'0', {0x3E, 0x51, 0x49, 0x45, 0x3E}}, {'1', {0x00, 0x42, 0x7F, 0x40, 0x00}},
    {'2', {0x42, 0x61, 0x51, 0x49, 0x46}}, {'3', {0x21, 0x41, 0x45, 0x4B, 0x31}},
    {'4', {0x18, 0x14, 0x12, 0x7F, 0x10}}, {'5', {0x27, 0x45, 0x45, 0x45, 0x39}},
    {'6', {0x3C, 0x4A, 0x49, 0x49, 0x30}}, {'7', {0x01, 0x71, 0x09, 0x05, 0x03}},
    {'8', {0x36, 0x49, 0x49, 0x49, 0x36}}, {'9', {0x06, 0x49, 0x49, 0x29, 0x1E}},
    {'a', {0x20, 0x54, 0x54, 0x54, 0x78}}, {'b', {0x7F, 0x48, 0x44, 0x44, 0x38}},
    {'c', {0x38, 0x44, 0x44, 0x44, 0x20}}, {'d', {0x38, 0x44, 0x44, 0x48, 0x7F}},
    {'e', {0x38, 0x54, 0x54, 0x54, 0x18}}, {'f', {0x08, 0x7E, 0x09, 0x01, 0x02}},
    {'g', {0x0C, 0x52, 0x52, 0x52, 0x3E}}, {'h', {0x7F, 0x08, 0x04, 0x04, 0x78}},
    {'i', {0x00, 0x44, 0x7D, 0x40, 0x00}}, {'j', {0x20, 0x40, 0x44, 0x3D, 0x00}},
    {'k', {0x7F, 0x10, 0x28, 0x44, 0x00}}, {'l', {0x00, 0x41, 0x7F, 0x40, 0x00}},
    {'m', {0x7C, 0x04, 0x18, 0x04, 0x78}}, {'n', {0x7C, 0x08, 0x04, 0x04, 0x78}},
    {'o', {0x38, 0x44, 0x44, 0x44, 0x38}}, {'p', {0x7C, 0x14, 0x14, 0x14, 0x08}},
    {'q', {0x08, 0x14, 0x14, 0x18, 0x7C}}, {'r', {0x7C, 0x08, 0x04, 0x04, 0x08}},
    {'s', {0x48, 0x54, 0x54, 0x54, 0x20}}, {'t', {0x04, 0x3F, 0x44, 0x40, 0x20}},
    {'u', {0x3C, 0x40, 0x40, 0x20, 0x7C}}, {'v', {0x1C, 0x20, 0x40, 0x20, 0x1C}},
    {'w', {0x3C, 0x40, 0x30, 0x40, 0x3C}}, {'x', {0x44, 0x28, 0x10, 0x28, 0x44}},
    {'y', {0x0C, 0x50, 0x50, 0x50, 0x3C}}, {'z', {0x44, 0x64, 0x54, 0x4C, 0x44}},
    {'[', {0x00, 0x7F, 0x41, 0x41, 0x00}}, {']', {0x00, 0x41, 0x41, 0x7F, 0x00}},
    {'%', {0x23, 0x13, 0x08, 0x64, 0x62}}, {'_', {0x40, 0x40, 0x40, 0x40, 0x40}},
    {'=', {0x14, 0x14, 0x14, 0x14, 0x14}}, {':', {0x00, 0x36, 0x36, 0x00, 0x00}},
};
// clang-format on

void blend(Picture& picture, int x, int y, Rgb color, float share) {
  if (x < 0 || y < 0 || x >= picture.width_px || y >= picture.height_px || share <= 0) return;
  Rgb& pixel = picture.at(x, y);
  const auto mix = [share](std::uint8_t below, std::uint8_t above) {
    return static_cast<std::uint8_t>(std::lround(below + share * (above - below)));
  };
  pixel = {mix(pixel.r, color.r), mix(pixel.g, color.g), mix(pixel.b, color.b)};
}

float distance_to_segment(float x, float y, ChartPoint a, ChartPoint b) {
  const float dx = b.x_px - a.x_px, dy = b.y_px - a.y_px;
  const float squared = dx * dx + dy * dy;
  const float along = squared > 0 ? ((x - a.x_px) * dx + (y - a.y_px) * dy) / squared : 0;
  const float t = std::clamp(along, 0.0f, 1.0f);
  return std::hypot(x - a.x_px - t * dx, y - a.y_px - t * dy);
}

void draw_segment(Picture& picture, ChartPoint a, ChartPoint b, const ChartStroke& stroke) {
  const float reach = stroke.width_px / 2 + 1;
  const int x_end = static_cast<int>(std::max(a.x_px, b.x_px) + reach);
  const int y_end = static_cast<int>(std::max(a.y_px, b.y_px) + reach);
  for (int y = static_cast<int>(std::min(a.y_px, b.y_px) - reach); y <= y_end; ++y)
    for (int x = static_cast<int>(std::min(a.x_px, b.x_px) - reach); x <= x_end; ++x) {
      const float distance =
          distance_to_segment(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, a, b);
      blend(picture, x, y, stroke.color, std::clamp(stroke.width_px / 2 + 0.5f - distance, 0.0f, 1.0f));
    }
}

void draw_stroke(Picture& picture, const ChartStroke& stroke) {
  if (stroke.points.size() == 1) draw_segment(picture, stroke.points[0], stroke.points[0], stroke);
  for (std::size_t i = 1; i < stroke.points.size(); ++i)
    draw_segment(picture, stroke.points[i - 1], stroke.points[i], stroke);
}

/// Capitals are drawn small; letters without a glyph are left blank.
std::array<std::uint8_t, 5> columns_of(char letter) {
  if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  for (const Glyph& glyph : kGlyphs)
    if (glyph.letter == letter) return glyph.columns;
  return {};
}

void draw_label(Picture& picture, const ChartLabel& label) {
  const int length_px = kGlyphPx * static_cast<int>(label.text.size()) - kDotPx;
  const int back_px = label.anchor == TextAnchor::start    ? 0
                      : label.anchor == TextAnchor::middle ? length_px / 2
                                                           : length_px;
  const int origin_x = static_cast<int>(label.at.x_px), origin_y = static_cast<int>(label.at.y_px);
  for (int along = 0; along < length_px; ++along)
    for (int down = 0; down < kTextHeightPx; ++down) {
      const auto letter = static_cast<std::size_t>(along / kGlyphPx);
      const int column = along % kGlyphPx / kDotPx;
      if (column > 4 ||
          !(columns_of(label.text[letter])[static_cast<std::size_t>(column)] >> (down / kDotPx) & 1))
        continue;
      const int u = along - back_px, v = down - kTextHeightPx / 2;
      if (label.upwards)
        blend(picture, origin_x + v, origin_y - u, kTextColor, 1);
      else
        blend(picture, origin_x + u, origin_y + v, kTextColor, 1);
    }
}

void draw_image(Picture& picture, const ChartImage& image) {
  const int left = static_cast<int>(image.upper_left.x_px), top = static_cast<int>(image.upper_left.y_px);
  for (int y = 0; y < image.picture.height_px; ++y)
    for (int x = 0; x < image.picture.width_px; ++x) {
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.picture.width_px) +
                      static_cast<std::size_t>(x);
      const float cover = image.cover.empty() ? 1 : static_cast<float>(image.cover[at]) / 255;
      blend(picture, left + x, top + y, image.picture.at(x, y), cover);
    }
}

}  // namespace

float text_width_px(const std::string& text) {
  return static_cast<float>(kGlyphPx * static_cast<int>(text.size()) - kDotPx);
}

Picture layout_to_picture(const ChartLayout& layout, int width_px, int height_px) {
  Picture picture(width_px, height_px, {255, 255, 255});
  for (const ChartStroke& stroke : layout.strokes) draw_stroke(picture, stroke);
  for (const ChartImage& image : layout.images) draw_image(picture, image);
  for (const ChartLabel& label : layout.labels) draw_label(picture, label);
  return picture;
}

Picture chart_to_picture(const LineChart& chart) {
  return layout_to_picture(lay_out(chart), chart.width_px, chart.height_px);
}

}  // namespace espalier
