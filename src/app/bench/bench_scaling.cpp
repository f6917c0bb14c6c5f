#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>

#include <espalier/app/bench/bench_cases.h>
#include <espalier/app/bench/bench_scaling.h>

namespace espalier {

namespace {

constexpr const char* kSpecies = "quaking_aspen";
constexpr std::array<double, 5> kFactors{0.25, 0.5, 1, 2, 4};

/// `quantity` is read off the result where the setting does not say it.
ScalingSeries measure_factors(const char* name, double seconds, bool leaves, RoleOfLevel role,
                              double preset_value, double BenchResult::*quantity) {
  ScalingSeries series{name, {}};
  for (const double factor : kFactors) {
    const BenchResult result =
        run_bench({kSpecies, 256, leaves, {{role, preset_value * factor}}}, seconds, 1);
    series.points.emplace_back(result.*quantity, 1 / result.per_second);
  }
  return series;
}

ScalingSeries measure_pixels(double seconds) {
  ScalingSeries series{"pixels", {}};
  for (const int size_px : {64, 128, 256, 512, 1024})
    series.points.emplace_back(size_px * size_px,
                               1 / run_bench({kSpecies, size_px, true, {}}, seconds, 1).per_second);
  return series;
}

ScalingSeries measure_threads(double seconds, int threads) {
  ScalingSeries series{"threads", {}};
  for (int count = 1; count <= threads; count *= 2)
    series.points.emplace_back(
        count, 1 / run_bench({kSpecies, 256, true, {}}, seconds, count).per_second_all_threads);
  return series;
}

constexpr std::array<Rgb, 4> kColors{Rgb{0, 114, 178}, Rgb{0, 158, 115}, Rgb{213, 94, 0}, Rgb{204, 121, 167}};

}  // namespace

std::vector<ScalingSeries> measure_scaling(double seconds, int threads) {
  return {measure_factors("stems", seconds, false, {Role::branch_count, 2}, 30, &BenchResult::stems),
          measure_factors("leaves", seconds, true, {Role::leaf_count}, 40, &BenchResult::leaf_count),
          measure_pixels(seconds), measure_threads(seconds, threads)};
}

double scaling_exponent(const ScalingSeries& series) {
  const auto n = static_cast<double>(series.points.size());
  double x_sum = 0, y_sum = 0, xx = 0, xy = 0;
  for (const auto& [quantity, seconds] : series.points) {
    const double x = std::log(quantity), y = std::log(seconds);
    x_sum += x, y_sum += y, xx += x * x, xy += x * y;
  }
  const double spread = n * xx - x_sum * x_sum;
  return series.points.size() < 2 || !(spread > 0) ? 0 : (n * xy - x_sum * y_sum) / spread;
}

LineChart scaling_chart(const std::vector<ScalingSeries>& series) {
  LineChart chart{.x_label = "log10 of the quantity, relative to its least",
                  .y_label = "log10 of ms for each evaluation",
                  .lines = {}};
  for (std::size_t i = 0; i < series.size(); ++i) {
    ChartLine line{.name = fmt::format("{}, slope {:.2f}", series[i].quantity, scaling_exponent(series[i])),
                   .color = kColors[i % kColors.size()],
                   .points = {}};
    for (const auto& [quantity, seconds] : series[i].points)
      line.points.emplace_back(std::log10(quantity / series[i].points.front().first),
                               std::log10(1e3 * seconds));
    chart.lines.push_back(line);
  }
  return chart;
}

}  // namespace espalier
