// Function files of vlab and L-studio (.func, versions 0 and 1.1): a function of one variable on [0, 1] as
// the control points of a clamped uniform cubic B-spline in the plane, whose x grows from 0 to 1. Its places
// are found by bisection, as vlab does.
//
//   range: 0.0 1.0        or    fver 1 1
//   points: 4                   name: bend
//   0 1.1                       samples: 10
//   …                           flip: off            how the editor turns it: means nothing here
//                               points: 4
//                               0 0.11 1             x, y and, in 1.1, how often the point counts
#pragma once
#include <string>
#include <vector>

#include <espalier/core/curves/curve.h>

namespace espalier {

struct PlanePoint {
  double x = 0, y = 0;
};

/// The control points of a file's text, each as often as it counts: 4 to 1000. Throws InputError with label,
/// line, got and expected for another version, fewer points than there should be, numbers that are not
/// finite, and an x that does not grow from 0 to 1.
std::vector<PlanePoint> read_func_points(const std::string& text, const std::string& label);

/// The value of the spline of these points at x; before 0 and after 1 that of the end.
double func_value(const std::vector<PlanePoint>& points, double x);

/// The least and the largest value of that spline.
struct ValueRange {
  double lower = 0, upper = 0;
};
ValueRange func_range(const std::vector<PlanePoint>& points);

/// The curve of few numbers that is nearest to a function file's, and how far it is from that at most.
struct NearestCurve {
  Curve curve;
  double error = 0;
};
/// Its numbers, which may reach further than its values, are kept in `bounds`.
NearestCurve nearest_curve(const std::vector<PlanePoint>& points, ValueRange bounds);

}  // namespace espalier
