#include <algorithm>
#include <cmath>

#include <espalier/fitting/search/solution_archive.h>

namespace espalier {

namespace {

constexpr double kToleratedShare = 0.05, kLeastTolerance = 0.002;  ///< of the best score; of any
constexpr double kAlike = 0.05;  ///< solutions closer than this are the same one

}  // namespace

double distance_between(const ArchivedSolution& a, const ArchivedSolution& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.unit.size(); ++i) sum += (a.unit[i] - b.unit[i]) * (a.unit[i] - b.unit[i]);
  return std::sqrt(sum / static_cast<double>(a.unit.size()));
}

SolutionArchive::SolutionArchive(SearchSpace space, std::size_t capacity)
    : space_(std::move(space)), capacity_(capacity) {}

double SolutionArchive::tolerance() const {
  return solutions_.empty() ? 0 : std::max(kLeastTolerance, kToleratedShare * solutions_.front().score);
}

void SolutionArchive::offer(const ParameterValues& values, double score) {
  if (!solutions_.empty() && score > solutions_.front().score + tolerance()) return;
  ArchivedSolution solution{values, space_.encode(values), score};
  const auto after = [](double value, const ArchivedSolution& other) { return value < other.score; };
  solutions_.insert(std::upper_bound(solutions_.begin(), solutions_.end(), score, after),
                    std::move(solution));
  const double worst = solutions_.front().score + tolerance();
  std::erase_if(solutions_, [&](const ArchivedSolution& other) { return other.score > worst; });
  while (drop_one_of_the_closest()) {
  }
}

/// The worse one of the closest two, where these are alike or there are too many.
bool SolutionArchive::drop_one_of_the_closest() {
  double least = INFINITY;
  std::size_t worse = 0;
  for (std::size_t j = 1; j < solutions_.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      if (const double distance = distance_between(solutions_[i], solutions_[j]); distance < least)
        least = distance, worse = j;
  if (worse == 0 || (least >= kAlike && solutions_.size() <= capacity_)) return false;
  solutions_.erase(solutions_.begin() + static_cast<std::ptrdiff_t>(worse));
  return true;
}

}  // namespace espalier
