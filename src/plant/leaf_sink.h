// Leaves on their way: a growing plant hands them over some hundreds at a time, instead of keeping them. Who
// draws them at once spares their memory, and the time to write it and to read it again. Metres.
#pragma once
#include <cstddef>

namespace espalier {

/// Leaves, no blossom, by columns; what they mean is told at Leaves [plant.h]. Seven numbers beyond the last
/// leaf can be read.
struct LeafColumns {
  struct Columns3 {
    const float *x, *y, *z;
  };
  Columns3 position_m, axis, side;
  const float *length_m, *width_m;
  std::size_t count = 0;
  int shape = 8;  ///< Plant::leaf_shape
};

class LeafSink {
 public:
  virtual ~LeafSink() = default;
  /// The columns are gone when it returns.
  virtual void take(const LeafColumns& leaves) = 0;
};

}  // namespace espalier
