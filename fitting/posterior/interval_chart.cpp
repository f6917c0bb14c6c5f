#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <espalier/fitting/posterior/interval_chart.h>

namespace espalier {

namespace {

constexpr float kRowPx = 20, kTopPx = 74, kBottomPx = 46, kGapPx = 24, kTrackPx = 420, kWordsPx = 330;
constexpr float kRightPx = 150;
constexpr Rgb kTrack{225, 225, 225}, kWide{158, 202, 225}, kNarrow{0, 114, 178}, kMedian{20, 20, 20};

struct Columns {
  float track_px = 0, words_px = 0, determination_px = 0, right_px = 0;

  float on_track(double share) const {
    return track_px + kTrackPx * static_cast<float>(std::clamp(share, 0.0, 1.0));
  }
};

Columns columns_of(const std::vector<UnknownSummary>& summaries) {
  float widest = 0;
  for (const UnknownSummary& row : summaries) widest = std::max(widest, text_width_px(row.unknown.name));
  const float track = 20 + widest + 14, words = track + kTrackPx + kGapPx, determination = words + kWordsPx;
  return {track, words, determination, determination + kRightPx};
}

void add_line(const Columns& columns, std::pair<double, double> shares, float y, Rgb color, float width_px,
              ChartLayout& layout) {
  layout.strokes.push_back(
      {{{columns.on_track(shares.first), y}, {columns.on_track(shares.second), y}}, color, width_px});
}

void add_heads(const Columns& columns, float bottom_px, ChartLayout& layout) {
  layout.labels.push_back({{20, 18},
                           "What the picture says of each unknown, for trees of any random numbers",
                           TextAnchor::start});
  layout.labels.push_back({{columns.on_track(0.5), 50}, "share of plants of the prior below"});
  layout.labels.push_back({{columns.words_px, 50}, "median [90 % interval]", TextAnchor::start});
  for (const double share : {0.0, 0.5, 1.0})
    layout.labels.push_back({{columns.on_track(share), bottom_px + 14}, fmt::format("{:g}", share)});
  layout.labels.push_back(
      {{columns.on_track(0), bottom_px + 32}, "light: 90 %, dark: 50 %, black: median", TextAnchor::start});
}

}  // namespace

std::string number_in_words(double number) {
  constexpr double kLeastWhole = 1000;  // three digits of these would take an exponent
  if (std::fabs(number) < kLeastWhole) return fmt::format("{:.3g}", number);
  const double unit = std::pow(10, std::floor(std::log10(std::fabs(number))) - 2);
  return fmt::format("{:.0f}", std::round(number / unit) * unit);
}

std::string interval_in_words(const UnknownSummary& summary) {
  const auto [low, high] = summary.intervals.back();
  const std::string& unit = summary.unknown.unit;
  return fmt::format("{} [{}, {}]{}{}", number_in_words(summary.median), number_in_words(low),
                     number_in_words(high), unit == "1" || unit.empty() ? "" : " ", unit == "1" ? "" : unit);
}

std::vector<std::size_t> chart_order(const std::vector<UnknownSummary>& summaries) {
  std::vector<std::size_t> order(summaries.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const UnknownSummary &first = summaries[a], &second = summaries[b];
    if (first.unknown.is_quantity != second.unknown.is_quantity) return first.unknown.is_quantity;
    return first.width_share < second.width_share;
  });
  return order;
}

PosteriorChart draw_intervals(const PosteriorEstimator& estimator,
                              const std::vector<UnknownSummary>& summaries) {
  const Columns columns = columns_of(summaries);
  const float bottom_px = kTopPx + kRowPx * static_cast<float>(summaries.size());
  PosteriorChart chart{{}, static_cast<int>(columns.right_px), static_cast<int>(bottom_px + kBottomPx)};
  add_heads(columns, bottom_px, chart.layout);
  float y = kTopPx + kRowPx / 2;
  for (const std::size_t i : chart_order(summaries)) {
    const UnknownSummary& row = summaries[i];
    const auto shares = [&](std::pair<double, double> ends) {
      return std::pair{estimator.prior_share(i, ends.first), estimator.prior_share(i, ends.second)};
    };
    chart.layout.labels.push_back({{columns.track_px - 14, y}, row.unknown.name, TextAnchor::end});
    add_line(columns, {0, 1}, y, kTrack, 4, chart.layout);
    add_line(columns, shares(row.intervals.back()), y, kWide, 8, chart.layout);
    add_line(columns, shares(row.intervals.front()), y, kNarrow, 8, chart.layout);
    chart.layout.strokes.push_back(
        {{{columns.on_track(estimator.prior_share(i, row.median)), y}}, kMedian, 9});
    chart.layout.labels.push_back({{columns.words_px, y}, interval_in_words(row), TextAnchor::start});
    chart.layout.labels.push_back(
        {{columns.determination_px, y}, name_of(row.determination), TextAnchor::start});
    y += kRowPx;
  }
  return chart;
}

}  // namespace espalier
