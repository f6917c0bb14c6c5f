// One picture does not say how far branches reach towards the viewer, nor where they are too thin to be seen,
// so a search would let them go anywhere. A tree is taken to be about as deep as it is wide, and to end in
// the picture.
#pragma once
#include <espalier/fitting/task/fit_task.h>

namespace espalier {

class ReachLimit {
 public:
  /// From the first view's target and camera. Several views limit each other's depth by themselves.
  explicit ReachLimit(const FitTask& task);

  /// How far the stems' knots go beyond the limit, in metres; 0 inside of it.
  float excess_m(const Plant& plant) const;

 private:
  float outside_px(const PicturePoint& seen) const;

  Camera camera_;
  float metres_per_px_ = 1, base_depth_m_ = 0, half_depth_m_ = 0;
};

}  // namespace espalier
