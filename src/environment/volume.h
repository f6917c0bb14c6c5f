// Volumes: closed regions of space in metres that plants are pruned to or grow in.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "core/vec3.h"

namespace espalier {

class Volume {
 public:
  virtual ~Volume() = default;
  /// True where the point lies inside. Safe to call from several threads at once.
  virtual bool contains(Vec3 point_m) const = 0;
};

}  // namespace espalier
