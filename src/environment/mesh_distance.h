// Distances to a triangle mesh by Embree's point queries. Metres.
#pragma once
#include <embree3/rtcore.h>

#include <espalier/environment/closed_mesh.h>

namespace espalier {

class MeshDistance {
 public:
  explicit MeshDistance(const ClosedMesh& mesh);
  ~MeshDistance();
  MeshDistance(const MeshDistance&) = delete;
  MeshDistance& operator=(const MeshDistance&) = delete;

  /// The unsigned distance to the nearest point of the surface. Safe to call from several threads at once.
  float to_surface_m(Vec3 point_m) const;

 private:
  ClosedMesh mesh_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace espalier
