// A small line chart as vector and as pixels: axes with ticks and labels, lines with names. The layout
// is one list of strokes and labels, which both writers draw, so that the two pictures agree.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include <espalier/image/pictures/picture.h>

namespace espalier {

struct ChartLine {
  std::string name;
  Rgb color;
  float width_px = 2;
  bool dots = false;                              ///< points instead of a line
  std::vector<std::pair<double, double>> points;  ///< in the units of the axes
};

/// Where something ends or begins: a line from bottom to top, with its name beside it.
struct ChartMark {
  std::string name;
  double x = 0;  ///< in the units of the axis
};

struct LineChart {
  std::string x_label, y_label;  ///< the latter may have several lines
  std::vector<ChartLine> lines;
  int width_px = 900, height_px = 540;
  std::vector<ChartMark> marks = {};  ///< by rising x
};

std::string chart_to_svg(const LineChart& chart);

/// The same chart as pixels, with a built-in font of 5×7 dots.
Picture chart_to_picture(const LineChart& chart);

/// Round numbers (1, 2 or 5 times a power of ten apart) inside [lower, upper], about `count` of them.
std::vector<double> axis_ticks(double lower, double upper, int count);

}  // namespace espalier
