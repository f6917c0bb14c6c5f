// Functions of the unit box with known minima, and an observer that keeps the whole trace.
#pragma once
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <espalier/fitting/optimizers/optimizer.h>

namespace espalier::test {

/// Evaluates row by row and counts rows.
class RowFunction : public Objective {
 public:
  explicit RowFunction(std::size_t dimension) : dimension_(dimension) {}
  std::size_t dimension() const override { return dimension_; }
  void evaluate(std::span<const double> points, std::span<double> values) const override {
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = value(points.subspan(i * dimension_, dimension_));
    count_ += static_cast<long>(values.size());
  }
  virtual double value(std::span<const double> x) const = 0;
  long count() const { return count_; }

 private:
  std::size_t dimension_;
  mutable std::atomic<long> count_ = 0;
};

/// The squared distance to a point off all grids: 0.3 + 0.4 frac(i * golden ratio).
class Sphere : public RowFunction {
 public:
  using RowFunction::RowFunction;
  static double centre(std::size_t i) {
    return 0.3 + 0.4 * std::fmod(0.618033988749895 * double(i + 1), 1.0);
  }
  double value(std::span<const double> x) const override {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += (x[i] - centre(i)) * (x[i] - centre(i));
    return sum;
  }
};

/// One value everywhere: no search direction, no improvement.
class Flat : public RowFunction {
 public:
  using RowFunction::RowFunction;
  double value(std::span<const double>) const override { return 3; }
};

/// A sphere of steps, as a mask of pixels is.
class Staircase : public Sphere {
 public:
  using Sphere::Sphere;
  double value(std::span<const double> x) const override { return std::floor(20 * Sphere::value(x)); }
};

/// A sphere with holes of NaN and both infinities.
class Holed : public Sphere {
 public:
  using Sphere::Sphere;
  double value(std::span<const double> x) const override {
    const double sphere = Sphere::value(x);
    switch (static_cast<int>(x[0] * 1000) % 4) {
      case 0:
        return std::numeric_limits<double>::quiet_NaN();
      case 1:
        return std::numeric_limits<double>::infinity();
      case 2:
        return -std::numeric_limits<double>::infinity();
      default:
        return sphere;
    }
  }
};

/// Fails at its `limit`-th evaluation.
class Failing : public Sphere {
 public:
  Failing(std::size_t dimension, long limit) : Sphere(dimension), limit_(limit) {}
  double value(std::span<const double> x) const override {
    if (++asked_ >= limit_) throw std::runtime_error("the objective failed");
    return Sphere::value(x);
  }

 private:
  long limit_;
  mutable long asked_ = 0;
};

/// Keeps all points and values; asks to stop after `stop_after` evaluations.
class Trace : public Observer {
 public:
  explicit Trace(long stop_after = std::numeric_limits<long>::max()) : stop_after_(stop_after) {}
  void on_batch(long first_evaluation, std::span<const double> batch,
                std::span<const double> results) override {
    in_order = in_order && first_evaluation == static_cast<long>(values.size());
    points.insert(points.end(), batch.begin(), batch.end());
    values.insert(values.end(), results.begin(), results.end());
    batch_sizes.push_back(results.size());
  }
  bool stop_requested() override { return static_cast<long>(values.size()) >= stop_after_; }

  std::vector<double> points, values;
  std::vector<std::size_t> batch_sizes;
  bool in_order = true;

 private:
  long stop_after_;
};

}  // namespace espalier::test
