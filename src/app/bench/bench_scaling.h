// How the time of an evaluation grows with the plant, the picture and the threads: power laws, as slopes in a
// plot of logarithms.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include <espalier/charts/line_chart.h>

namespace espalier {

/// Time against one quantity, all else the same.
struct ScalingSeries {
  std::string quantity;                           ///< "stems", "leaves", "pixels", "threads"
  std::vector<std::pair<double, double>> points;  ///< the quantity, and seconds for each evaluation
};

/// Measures the quaking aspen: bare with more and more stems, then with leaves, in larger pictures, on more
/// threads. Each point takes about `seconds`.
std::vector<ScalingSeries> measure_scaling(double seconds, int threads);

/// The exponent b of time = a · quantity^b, by least squares in logarithms; 0 for less than two points.
double scaling_exponent(const ScalingSeries& series);

/// One line a series, from its first point on, both axes in decimal logarithms.
LineChart scaling_chart(const std::vector<ScalingSeries>& series);

}  // namespace espalier
