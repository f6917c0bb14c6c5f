// A few good and different solutions of one search: each scores nearly as well as the best, and no two lie
// close to each other in the box that was searched. Distances are root mean squares over the coordinates of
// that box, so 1 is from one end of every range to the other. What is kept depends on the order of what is
// offered and on nothing else.
#pragma once
#include <vector>

#include <espalier/fitting/record/search_space.h>

namespace espalier {

struct ArchivedSolution {
  ParameterValues values;
  std::vector<double> unit;  ///< its coordinates in the box
  double score = 1;          ///< dissimilarity, 0 is best
};

double distance_between(const ArchivedSolution& a, const ArchivedSolution& b);

class SolutionArchive {
 public:
  explicit SolutionArchive(SearchSpace space, std::size_t capacity = 8);

  /// Keeps the solution where it is good and different; may drop others for it, never the best.
  void offer(const ParameterValues& values, double score);

  const std::vector<ArchivedSolution>& solutions() const { return solutions_; }  ///< the best first
  const SearchSpace& space() const { return space_; }
  /// Solutions up to this much worse than the best are good.
  double tolerance() const;

 private:
  bool drop_one_of_the_closest();

  SearchSpace space_;
  std::size_t capacity_;
  std::vector<ArchivedSolution> solutions_;
};

}  // namespace espalier
