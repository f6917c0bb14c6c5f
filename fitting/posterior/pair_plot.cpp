#include <fmt/format.h>

#include <algorithm>
#include <array>

#include <espalier/fitting/posterior/pair_plot.h>

namespace espalier {

namespace {

constexpr float kCellPx = 96, kCellGapPx = 8, kNamesPx = 190, kGridTopPx = 34, kTicksPx = 70;
constexpr Rgb kFrame{200, 200, 200}, kDot{0, 114, 178}, kBar{158, 202, 225};
constexpr Eigen::Index kMostDots = 300;

struct Axis {
  double lower = 0, upper = 1;
  double share(double value) const { return upper > lower ? (value - lower) / (upper - lower) : 0.5; }
};

/// Upper left corner of a cell.
ChartPoint corner_of(std::size_t column, std::size_t row) {
  return {kNamesPx + (kCellPx + kCellGapPx) * static_cast<float>(column),
          kGridTopPx + (kCellPx + kCellGapPx) * static_cast<float>(row)};
}

void add_frame(ChartPoint at, ChartLayout& layout) {
  const ChartPoint end{at.x_px + kCellPx, at.y_px + kCellPx};
  layout.strokes.push_back({{at, {end.x_px, at.y_px}, end, {at.x_px, end.y_px}, at}, kFrame, 1});
}

ChartPoint in_cell(ChartPoint at, double right, double up) {
  constexpr float kMargin = 0.05f;
  const auto place = [](double share) {
    return kCellPx * (kMargin + (1 - 2 * kMargin) * static_cast<float>(share));
  };
  return {at.x_px + place(right), at.y_px + kCellPx - place(up)};
}

void add_dots(const Eigen::VectorXd& x, const Eigen::VectorXd& y, Axis x_axis, Axis y_axis, ChartPoint at,
              ChartLayout& layout) {
  const Eigen::Index step = std::max<Eigen::Index>(1, x.size() / kMostDots);
  for (Eigen::Index i = 0; i < x.size(); i += step)
    layout.strokes.push_back({{in_cell(at, x_axis.share(x[i]), y_axis.share(y[i]))}, kDot, 2});
}

void add_histogram(const Eigen::VectorXd& values, Axis axis, ChartPoint at, ChartLayout& layout) {
  std::array<double, 16> counts{};
  const auto bins = static_cast<double>(counts.size());
  for (const double value : values)
    counts[static_cast<std::size_t>(std::clamp(axis.share(value) * bins, 0.0, bins - 1))] += 1;
  const double most = *std::max_element(counts.begin(), counts.end());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] <= 0) continue;
    const double middle = (static_cast<double>(i) + 0.5) / bins;
    layout.strokes.push_back(
        {{in_cell(at, middle, 0), in_cell(at, middle, counts[i] / most)}, kBar, kCellPx / 18});
  }
}

}  // namespace

std::vector<std::size_t> plotted_unknowns(const std::vector<UnknownSummary>& summaries, std::size_t count) {
  std::vector<std::size_t> chosen = chart_order(summaries);
  chosen.resize(std::min(count, chosen.size()));
  return chosen;
}

PosteriorChart draw_pairs(const Eigen::MatrixXd& samples, const std::vector<UnknownSummary>& summaries,
                          const std::vector<std::size_t>& unknowns) {
  const auto side = static_cast<float>(unknowns.size()) * (kCellPx + kCellGapPx);
  PosteriorChart chart{
      {}, static_cast<int>(kNamesPx + side + 20), static_cast<int>(kGridTopPx + side + kTicksPx)};
  chart.layout.labels.push_back({{20, 16}, "Draws of the posterior, pair by pair", TextAnchor::start});
  std::vector<Axis> axes;
  axes.reserve(unknowns.size());
  const auto column = [&](std::size_t i) { return samples.col(static_cast<Eigen::Index>(unknowns[i])); };
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    axes.push_back({column(i).minCoeff(), column(i).maxCoeff()});
  for (std::size_t row = 0; row < unknowns.size(); ++row) {
    for (std::size_t i = 0; i <= row; ++i) {
      const ChartPoint at = corner_of(i, row);
      add_frame(at, chart.layout);
      if (i == row)
        add_histogram(column(i), axes[i], at, chart.layout);
      else
        add_dots(column(i), column(row), axes[i], axes[row], at, chart.layout);
    }
    const std::string& name = summaries[unknowns[row]].unknown.name;
    const ChartPoint left = corner_of(0, row), below = corner_of(row, unknowns.size());
    chart.layout.labels.push_back({{left.x_px - 8, left.y_px + kCellPx / 2}, name, TextAnchor::end});
    chart.layout.labels.push_back(
        {{below.x_px + kCellPx / 2, below.y_px + 4}, number_in_words(axes[row].lower)});
    chart.layout.labels.push_back({{below.x_px + kCellPx / 2, below.y_px + 18},
                                   fmt::format("to {}", number_in_words(axes[row].upper))});
  }
  return chart;
}

}  // namespace espalier
