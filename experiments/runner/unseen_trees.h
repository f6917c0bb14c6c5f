// How parameters do with other random numbers: a fit knows the trees of its own seeds, but its parameters
// describe a species. Trees of new seeds show what was learnt of it, and those of the true parameters, where
// they are known, the line to beat.
#pragma once
#include <string>

#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/task/fit_task.h>

namespace espalier {

struct UnseenScore {
  double fitness = 0, iou = 0;  ///< means over the trees
};

class UnseenTrees {
 public:
  /// `count` seeds that a fit of this record never uses, against its target.
  UnseenTrees(FitRecord record, int count);

  const std::vector<Seed>& seeds() const { return task_.plant_seeds; }

  UnseenScore score(const ParameterValues& values) const;

  /// The values of a species as fits begin with them: as tall as the target, the size not varying.
  ParameterValues truth(const std::string& species) const;

 private:
  FitRecord record_;
  FitTask task_;
};

/// What the true parameters reach with the seeds that a fit of this record never uses, whatever its model.
UnseenScore score_truth(FitRecord record, const std::string& species, int count);

}  // namespace espalier
