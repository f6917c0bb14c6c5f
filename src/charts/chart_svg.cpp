// The chart as SVG 1.1: one element a stroke or label.
#include <fmt/format.h>

#include <espalier/charts/chart_layout.h>
#include <espalier/core/text/base64.h>

namespace espalier {

namespace {

std::string hex(Rgb color) { return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b); }

std::string escape_xml(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '&')
      escaped += "&amp;";
    else
      escaped += c;
  }
  return escaped;
}

std::string stroke_to_svg(const ChartStroke& stroke) {
  if (stroke.points.size() == 1)
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\"/>\n",
                       stroke.points[0].x_px, stroke.points[0].y_px, stroke.width_px / 2, hex(stroke.color));
  std::string points;
  for (const ChartPoint& point : stroke.points)
    points += fmt::format("{:.1f},{:.1f} ", point.x_px, point.y_px);
  return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"/>\n", points,
                     hex(stroke.color), stroke.width_px);
}

std::string label_to_svg(const ChartLabel& label) {
  constexpr const char* kAnchors[] = {"start", "middle", "end"};
  const std::string turned =
      label.upwards ? fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", label.at.x_px, label.at.y_px)
                    : "";
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", label.at.x_px,
                     label.at.y_px + 5, kAnchors[static_cast<int>(label.anchor)], turned,
                     escape_xml(label.text));
}

std::string image_to_svg(const ChartImage& image) {
  return fmt::format(
      "<image x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" href=\"data:image/png;base64,{}\"/>\n",
      image.upper_left.x_px, image.upper_left.y_px, image.picture.width_px, image.picture.height_px,
      base64(png_bytes(image.picture, image.cover)));
}

}  // namespace

std::string layout_to_svg(const ChartLayout& layout, int width_px, int height_px) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"15\" fill=\"#3c3c3c\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      width_px, height_px);
  for (const ChartStroke& stroke : layout.strokes) svg += stroke_to_svg(stroke);
  for (const ChartImage& image : layout.images) svg += image_to_svg(image);
  for (const ChartLabel& label : layout.labels) svg += label_to_svg(label);
  return svg + "</svg>\n";
}

std::string chart_to_svg(const LineChart& chart) {
  return layout_to_svg(lay_out(chart), chart.width_px, chart.height_px);
}

}  // namespace espalier
