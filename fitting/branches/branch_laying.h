// Laying a branch on a line of the picture: an evolution strategy bends, turns, shortens and moves it along
// its parent, by offsets (branch_offsets.h), until it lies there. How deep it goes no silhouette says: that
// is given.
#pragma once
#include <vector>

#include <espalier/fitting/branches/branch_offsets.h>
#include <espalier/fitting/optimizers/random_stream.h>
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
  /// `reseeds`: the branch may get other random numbers.
  BranchLayer(const FitTask& task, bool reseeds) : task_(task), reseeds_(reseeds) {}

  /// The offsets with which the branch of this path of `tree` lies on the line.
  BranchOffsets lay(const LineInPicture& line, const BranchPath& path, const Solution& tree,
                    RandomStream& draws);

 private:
  BranchOffsets mutated(BranchOffsets branch, double sigma, RandomStream& draws) const;
  bool try_one(const BranchOffsets& branch, Solution& one, BranchOffsets& best, double& best_error);
  bool grow(const BranchOffsets& branch, Solution& one);
  double error_of(const BranchOffsets& branch, Solution& one);
  void set_radius(double width_px, BranchOffsets& branch, Solution& one);

  const FitTask& task_;
  bool reseeds_;
  Plant plant_;
  std::vector<PixelPoint> target_, grown_;
  double outward_ = 0;
};

}  // namespace espalier
