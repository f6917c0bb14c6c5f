// Convex shapes of up to four edges by scan lines: where each row enters and leaves them. Pixels.
#pragma once
#include <algorithm>
#include <cmath>

#include <espalier/image/masks/mask.h>
#include <espalier/render/scanlines/span.h>

namespace espalier {

/// Bounds on x along scan lines by half planes c·x <= e + f·y, relative to some point.
class RowLimits {
 public:
  void add(float c, float e, float f) {
    const float steep = std::copysign(std::max(std::fabs(c), 1e-12f), c);
    Line& line = steep > 0 ? upper_[count_] : lower_[count_];
    line = {e / steep, f / steep};
    ++count_;
  }
  float low(float y) const {
    return std::max(std::max(lower_[0].at(y), lower_[1].at(y)), std::max(lower_[2].at(y), lower_[3].at(y)));
  }
  float high(float y) const {
    return std::min(std::min(upper_[0].at(y), upper_[1].at(y)), std::min(upper_[2].at(y), upper_[3].at(y)));
  }

 private:
  static constexpr float kFar = 1e9f;
  struct Line {
    float e, f;
    float at(float y) const { return e + f * y; }
  };
  Line lower_[4] = {{-kFar, 0}, {-kFar, 0}, {-kFar, 0}, {-kFar, 0}};
  Line upper_[4] = {{kFar, 0}, {kFar, 0}, {kFar, 0}, {kFar, 0}};
  int count_ = 0;
};

/// Sets the pixels of a row whose centres lie in [low, high].
inline void draw_run(Mask& mask, int row, float low, float high) {
  const PixelRun run = centres_between(low, high, mask.width_px());
  if (run.begin < run.end) set_span(mask.row(row).data(), run.begin, run.end);
}

}  // namespace espalier
