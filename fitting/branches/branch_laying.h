// Laying a branch on a line of the picture: it gets an axis (overrides/drawn_axis.h) in the world's frame, by
// linear least squares, and the length of that. What grows is looked at a few times: to move the branch along
// its parent to where the line begins, to choose the side of the parent that it stands on, and to see how
// long and how thick it is. How deep it goes no silhouette says: that is given.
#pragma once
#include <optional>
#include <vector>

#include <espalier/fitting/branches/branch_offsets.h>
#include <espalier/fitting/task/fit_task.h>
#include <espalier/image/reading/medial_axes.h>

namespace espalier {

struct LineInPicture {
  std::vector<PixelPoint> points;  ///< from base to tip, in the first view
  double width_px = 0;             ///< at its base, of the branch that is to lie there
  double outward = 0;  ///< how far its tip is from the viewer, over the distance of its ends in the picture
};

class BranchLayer {
 public:
  explicit BranchLayer(const FitTask& task) : task_(task) {}

  /// The offsets and the axis with which the branch of this path of `tree` lies on the line. Those of a
  /// branch that does not grow are none.
  BranchOffsets lay(const LineInPicture& line, const BranchPath& path, const Solution& tree);

  /// How often lay() has grown a branch.
  long evaluations() const { return evaluations_; }

 private:
  bool grow(const BranchOffsets& branch, Solution& one);
  std::optional<Vec3> base_of(const BranchOffsets& branch, Solution& one);
  void move_to_start(const LineInPicture& line, BranchOffsets& branch, Solution& one);
  void lift_line(const LineInPicture& line, double depth_m);
  void choose_side(const LineInPicture& line, BranchOffsets& branch, Solution& one);
  bool follow_line(const LineInPicture& line, BranchOffsets& branch, Solution& one);
  void set_radius(double width_px, BranchOffsets& branch, Solution& one);

  const FitTask& task_;
  Plant plant_;
  std::vector<Vec3> line_m_;  ///< in space, evenly spaced
  long evaluations_ = 0;
};

}  // namespace espalier
