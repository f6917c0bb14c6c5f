// Laying a branch on a line of the picture: it gets an axis (overrides/drawn_axis.h) in the world's frame, by
// linear least squares, the length of that, and the radii. What grows is looked at a few times: to move the
// branch along its parent to where the line begins, to choose the side of the parent that it stands on, and
// to see how long and how thick it is. How deep it goes no silhouette says: that is given.
#pragma once
#include <optional>
#include <vector>

#include <espalier/fitting/branches/branch_offsets.h>
#include <espalier/fitting/task/fit_task.h>
#include <espalier/image/reading/medial_axes.h>

namespace espalier {

struct LineInPicture {
  std::vector<PixelPoint> points;  ///< from base to tip, in the first view
  std::vector<float> widths_px;    ///< at the points, of the branch that is to lie there; none: its own
  std::vector<double> deeper_px;   ///< how much further from the viewer than its base; none: not at all
};

/// How a branch has to be changed to lie on a line, and how thick it is then and should be, at places evenly
/// spaced along it; nothing of what does not grow or of lines without widths.
struct LaidBranch {
  BranchOffsets offsets;
  std::vector<double> grown_radius_m, wanted_radius_m;
};

class BranchLayer {
 public:
  explicit BranchLayer(const FitTask& task) : task_(task) {}

  /// The offsets and the axis with which the branch of this path of `tree` lies on the line. Those of a
  /// branch that does not grow are none.
  LaidBranch lay(const LineInPicture& line, const BranchPath& path, const Solution& tree);

  /// The curve of the model that multiplies the radius along branches of this one's level; nullptr where it
  /// has none, or the branch does not grow.
  const CurveInfo* radius_curve(const BranchPath& path, const Solution& tree);

  /// How often lay() has grown a branch.
  long evaluations() const { return evaluations_; }

 private:
  bool grow(const BranchOffsets& branch, Solution& one);
  std::optional<Vec3> base_of(const BranchOffsets& branch, Solution& one);
  void move_to_start(const LineInPicture& line, BranchOffsets& branch, Solution& one);
  void lift_line(const LineInPicture& line, double depth_m);
  void choose_side(const LineInPicture& line, BranchOffsets& branch, Solution& one);
  bool follow_line(const LineInPicture& line, BranchOffsets& branch, Solution& one);
  void set_radius(LaidBranch& laid, Solution& one);
  std::vector<double> radii_along_m() const;

  const FitTask& task_;
  Plant plant_;
  std::vector<Vec3> line_m_;      ///< in space
  std::vector<double> shares_;    ///< of its length, of its points
  std::vector<double> radius_m_;  ///< at its points
  std::size_t first_ = 0;         ///< point of the line at which the branch begins
  long evaluations_ = 0;
};

}  // namespace espalier
