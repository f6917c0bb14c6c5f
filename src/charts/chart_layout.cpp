#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include <espalier/charts/chart_layout.h>

namespace espalier {

namespace {

constexpr float kLeftPx = 96, kRightPx = 24, kTopPx = 16, kLegendRowPx = 24, kBottomPx = 64, kTickPx = 6;
constexpr float kLinePx = 20;  ///< from one line of a text to the next
constexpr Rgb kInk{60, 60, 60}, kGrid{225, 225, 225}, kMark{150, 150, 150};

struct Axis {
  double lower, upper;
  float at_lower_px, at_upper_px;

  float to_px(double value) const {
    const double share = (value - lower) / (upper - lower);
    return static_cast<float>(at_lower_px + share * (at_upper_px - at_lower_px));
  }
};

struct Axes {
  Axis x, y;

  ChartPoint to_px(std::pair<double, double> point) const {
    return {x.to_px(point.first), y.to_px(point.second)};
  }
};

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  for (auto end = text.find('\n'); end != text.npos; end = text.find('\n')) {
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  lines.emplace_back(text);
  return lines;
}

/// Left of the axis: its ticks, and as many lines as its label has.
float left_px(const LineChart& chart) {
  return kLeftPx + kLinePx * static_cast<float>(lines_of(chart.y_label).size() - 1);
}

/// The range of one coordinate over all lines, never empty.
std::pair<double, double> range_of(const LineChart& chart, bool horizontal) {
  double lower = INFINITY, upper = -INFINITY;
  for (const ChartLine& line : chart.lines)
    for (const auto& [x, y] : line.points) {
      lower = std::min(lower, horizontal ? x : y);
      upper = std::max(upper, horizontal ? x : y);
    }
  if (!(lower <= upper)) return {0, 1};
  return upper > lower ? std::pair{lower, upper} : std::pair{lower - 0.5, upper + 0.5};
}

/// Where each line's sample begins in the legend, which takes as many rows above the plot as it needs.
std::vector<ChartPoint> legend_places(const LineChart& chart) {
  constexpr float kSamplePx = 32, kLetterPx = 12, kGapPx = 28;
  const float first_px = left_px(chart) + 12;
  std::vector<ChartPoint> places;
  ChartPoint next{first_px, kTopPx};
  for (const ChartLine& line : chart.lines) {
    const float width_px = kSamplePx + kLetterPx * static_cast<float>(line.name.size());
    if (next.x_px > first_px && next.x_px + width_px > static_cast<float>(chart.width_px))
      next = {first_px, next.y_px + kLegendRowPx};
    places.push_back(next);
    next.x_px += width_px + kGapPx;
  }
  return places;
}

Axes make_axes(const LineChart& chart) {
  const auto [x_lower, x_upper] = range_of(chart, true);
  const auto [y_lower, y_upper] = range_of(chart, false);
  const double margin = 0.04 * (y_upper - y_lower);
  const float top_px =
      kTopPx + kLegendRowPx + (chart.lines.empty() ? 0 : legend_places(chart).back().y_px - kTopPx);
  return {{std::min(x_lower, 0.0), x_upper, left_px(chart), static_cast<float>(chart.width_px) - kRightPx},
          {y_lower - margin, y_upper + margin, static_cast<float>(chart.height_px) - kBottomPx, top_px}};
}

void add_axis_lines(const Axes& axes, ChartLayout& layout) {
  layout.strokes.push_back({{{axes.x.at_lower_px, axes.y.at_upper_px},
                             {axes.x.at_lower_px, axes.y.at_lower_px},
                             {axes.x.at_upper_px, axes.y.at_lower_px}},
                            kInk,
                            1});
}

void add_x_ticks(const Axes& axes, ChartLayout& layout) {
  for (const double tick : axis_ticks(axes.x.lower, axes.x.upper, 8)) {
    const float x = axes.x.to_px(tick), y = axes.y.at_lower_px;
    layout.strokes.push_back({{{x, y}, {x, y + kTickPx}}, kInk, 1});
    layout.labels.push_back({{x, y + kTickPx + 12}, fmt::format("{:g}", tick)});
  }
}

void add_y_ticks(const Axes& axes, ChartLayout& layout) {
  for (const double tick : axis_ticks(axes.y.lower, axes.y.upper, 6)) {
    const float x = axes.x.at_lower_px, y = axes.y.to_px(tick);
    layout.strokes.push_back({{{x + 1, y}, {axes.x.at_upper_px, y}}, kGrid, 1});
    layout.strokes.push_back({{{x - kTickPx, y}, {x, y}}, kInk, 1});
    layout.labels.push_back({{x - kTickPx - 5, y}, fmt::format("{:g}", tick), TextAnchor::end});
  }
}

/// Names stand to the right of their lines, one above the other where lines are close.
void add_marks(const Axes& axes, const LineChart& chart, ChartLayout& layout) {
  constexpr float kBesidePx = 11, kGapPx = 12;
  ChartPoint last{-kLinePx, 0};
  for (const ChartMark& mark : chart.marks) {
    const float x = axes.x.to_px(mark.x);
    layout.strokes.push_back({{{x, axes.y.at_lower_px}, {x, axes.y.at_upper_px}}, kMark, 1});
    const bool is_close = x - last.x_px < kLinePx;
    const ChartPoint foot{x, is_close ? last.y_px : axes.y.at_lower_px - kGapPx};
    layout.labels.push_back({{x + kBesidePx, foot.y_px}, mark.name, TextAnchor::start, true});
    last = {x, foot.y_px - text_width_px(mark.name) - kGapPx};
  }
}

void add_y_label(const LineChart& chart, float middle_y_px, ChartLayout& layout) {
  float x = 18;
  for (const std::string& line : lines_of(chart.y_label)) {
    layout.labels.push_back({{x, middle_y_px}, line, TextAnchor::middle, true});
    x += kLinePx;
  }
}

void add_line(const Axes& axes, const ChartLine& line, ChartLayout& layout) {
  ChartStroke stroke{{}, line.color, line.width_px};
  for (const auto& point : line.points) {
    if (line.dots)
      layout.strokes.push_back({{axes.to_px(point)}, line.color, line.width_px});
    else
      stroke.points.push_back(axes.to_px(point));
  }
  if (!stroke.points.empty()) layout.strokes.push_back(std::move(stroke));
}

void add_legend(const LineChart& chart, ChartLayout& layout) {
  const std::vector<ChartPoint> places = legend_places(chart);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const ChartLine& line = chart.lines[i];
    const auto [x, y] = places[i];
    if (line.dots)
      layout.strokes.push_back({{{x + 12, y}}, line.color, line.width_px});
    else
      layout.strokes.push_back({{{x, y}, {x + 24, y}}, line.color, line.width_px});
    layout.labels.push_back({{x + 32, y}, line.name, TextAnchor::start});
  }
}

}  // namespace

std::vector<double> axis_ticks(double lower, double upper, int count) {
  const double rough = (upper - lower) / std::max(count, 1);
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double leading = rough / power;
  const double step = power * (leading < 1.5 ? 1 : leading < 3.5 ? 2 : leading < 7.5 ? 5 : 10);
  std::vector<double> ticks;
  for (double i = std::ceil(lower / step - 1e-9); i * step <= upper + 1e-9 * step; ++i)
    ticks.push_back(i * step + 0.0);  // + 0.0: never -0
  return ticks;
}

ChartLayout lay_out(const LineChart& chart) {
  const Axes axes = make_axes(chart);
  ChartLayout layout;
  add_y_ticks(axes, layout);
  add_x_ticks(axes, layout);
  add_axis_lines(axes, layout);
  add_marks(axes, chart, layout);
  for (const ChartLine& line : chart.lines) add_line(axes, line, layout);
  add_legend(chart, layout);
  const float middle_x = (axes.x.at_lower_px + axes.x.at_upper_px) / 2;
  const float middle_y = (axes.y.at_lower_px + axes.y.at_upper_px) / 2;
  layout.labels.push_back({{middle_x, static_cast<float>(chart.height_px) - 18}, chart.x_label});
  add_y_label(chart, middle_y, layout);
  return layout;
}

}  // namespace espalier
