// What a chart is drawn from: strokes and labels in pixels, y down.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <espalier/charts/line_chart.h>

namespace espalier {

struct ChartPoint {
  float x_px = 0, y_px = 0;
};

struct ChartStroke {
  std::vector<ChartPoint> points;  ///< one point is a dot
  Rgb color;
  float width_px = 1;
};

enum class TextAnchor { start, middle, end };

struct ChartLabel {
  ChartPoint at;  ///< the middle of the text's height
  std::string text;
  TextAnchor anchor = TextAnchor::middle;
  bool upwards = false;  ///< reads from bottom to top
};

/// A picture with the share of each pixel that it covers; what is below shines through.
struct ChartImage {
  ChartPoint upper_left;
  Picture picture;
  std::vector<std::uint8_t> cover;  ///< 0 … 255 a pixel; empty: all of it
};

/// Drawn in this order.
struct ChartLayout {
  std::vector<ChartStroke> strokes;
  std::vector<ChartImage> images;
  std::vector<ChartLabel> labels;
};

/// Length of a text as chart pictures draw it.
float text_width_px(const std::string& text);

std::string layout_to_svg(const ChartLayout& layout, int width_px, int height_px);

/// The same as pixels, with a built-in font of 5×7 dots (small letters; capitals are drawn as such).
Picture layout_to_picture(const ChartLayout& layout, int width_px, int height_px);

ChartLayout lay_out(const LineChart& chart);

}  // namespace espalier
