// What a chart is drawn from: strokes and labels in pixels, y down.
#pragma once
#include <string>
#include <vector>

#include "fitting/line_chart.h"

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

struct ChartLayout {
  std::vector<ChartStroke> strokes;
  std::vector<ChartLabel> labels;
};

ChartLayout lay_out(const LineChart& chart);

}  // namespace espalier
