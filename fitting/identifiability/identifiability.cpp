#include <algorithm>
#include <cmath>

#include <espalier/fitting/identifiability/identifiability.h>
#include <espalier/fitting/optimizers/random_stream.h>

namespace espalier {

namespace {

// Of the search for solutions elsewhere.
constexpr long kMostProbes = 192;
constexpr std::size_t kProbesAtOnce = 16, kMostMoved = 8;
constexpr double kLeastRise = 1e-4;  ///< of a step that seems to cost nothing

constexpr double kNarrow = 0.25, kWide = 0.5;  ///< spreads of what is determined, and of what is open
constexpr double kCheap = 0.25;                ///< a step costs less than this share of the tolerance

/// How far one step goes, in units of the box.
double step_of(const FreeParameter& parameter) {
  if (parameter.mapping != Mapping::whole) return kSensitivityStep;
  const double slices = parameter.upper - parameter.lower + 1;
  return std::max(kSensitivityStep, (parameter.split_at_zero ? 0.5 : 1) / slices);
}

ParameterValues moved(const ParameterValues& values, const FreeParameter& parameter, double unit) {
  ParameterValues other = values;
  other[parameter.row] = value_at(parameter, unit);
  return other;
}

/// Where a step leads; none where the range ends before it is half made.
std::optional<double> stepped(const FreeParameter& parameter, double unit, double direction) {
  const double step = step_of(parameter), to = std::clamp(unit + direction * step, 0.0, 1.0);
  if (std::fabs(to - unit) < step / 2) return std::nullopt;
  return to;
}

class Measurement {
 public:
  Measurement(SolutionArchive& archive, Scorer& scorer) : archive_(archive), scorer_(scorer) {}

  IdentifiabilityReport report(long allowed, Seed seed) {
    take_steps();
    const long probes = std::min(kMostProbes, allowed - evaluations_);
    for (long first = 0; first < probes; first += static_cast<long>(kProbesAtOnce))
      look_elsewhere(random_stream_at(root_key(seed), 1, static_cast<std::uint64_t>(first)),
                     std::min(kProbesAtOnce, static_cast<std::size_t>(probes - first)));
    for (ParameterIdentifiability& row : rows_) describe(row);
    return {rows_, archive_.tolerance(), evaluations_};
  }

 private:
  const ArchivedSolution& best() const { return archive_.solutions().front(); }

  /// Scores them and offers them to the archive.
  std::vector<double> score(const std::vector<ParameterValues>& candidates) {
    std::vector<double> scores(candidates.size());
    scorer_.score(candidates, scores);
    evaluations_ += static_cast<long>(candidates.size());
    const double least = best().score;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (scores[i] >= least) archive_.offer(candidates[i], scores[i]);
    return scores;
  }

  /// One parameter at a time, down and up.
  void take_steps() {
    std::vector<ParameterValues> candidates;
    std::vector<std::optional<double>*> rises;
    const std::vector<FreeParameter>& free = archive_.space().free;
    const ArchivedSolution start = best();
    for (std::size_t i = 0; i < free.size(); ++i)
      rows_.push_back({.parameter = free[i], .best = start.values[free[i].row]});
    for (std::size_t i = 0; i < free.size(); ++i)
      for (const double direction : {-1.0, 1.0})
        if (const auto unit = stepped(free[i], start.unit[i], direction)) {
          candidates.push_back(moved(start.values, free[i], *unit));
          rises.push_back(direction < 0 ? &rows_[i].rise_below : &rows_[i].rise_above);
        }
    const std::vector<double> scores = score(candidates);
    for (std::size_t i = 0; i < scores.size(); ++i) *rises[i] = scores[i] - start.score;
  }

  /// Several parameters at once, each the further the less its steps cost: the rise is taken to grow as the
  /// square of the way, and the sum of all to stay about within the tolerance.
  void look_elsewhere(RandomStream draws, std::size_t count) {
    std::vector<ParameterValues> candidates;
    for (std::size_t i = 0; i < count; ++i) {
      const ArchivedSolution& from = archive_.solutions()[draws.below(archive_.solutions().size())];
      candidates.push_back(from.values);
      const std::size_t moves = 1 + draws.below(kMostMoved);
      for (std::size_t move = 0; move < moves; ++move) {
        const std::size_t j = draws.below(rows_.size());
        const double rise = std::max(kLeastRise, rows_[j].least_rise());
        const double way = step_of(rows_[j].parameter) *
                           std::sqrt(archive_.tolerance() / (static_cast<double>(moves) * rise));
        candidates.back() =
            moved(candidates.back(), rows_[j].parameter, from.unit[j] + std::min(way, 0.5) * draws.normal());
      }
    }
    score(candidates);
  }

  void describe(ParameterIdentifiability& row) const {
    const auto index = static_cast<std::size_t>(&row - rows_.data());
    double least = 1, most = 0;
    row.lowest = INFINITY, row.highest = -INFINITY;
    for (const ArchivedSolution& solution : archive_.solutions()) {
      least = std::min(least, solution.unit[index]), most = std::max(most, solution.unit[index]);
      row.lowest = std::min(row.lowest, solution.values[row.parameter.row]);
      row.highest = std::max(row.highest, solution.values[row.parameter.row]);
    }
    row.spread = most - least;
    row.identifiability = judge(row);
  }

  Identifiability judge(const ParameterIdentifiability& row) const {
    if (row.rise_below.value_or(0) == 0 && row.rise_above.value_or(0) == 0) return Identifiability::no_effect;
    const double steps = row.least_rise() / archive_.tolerance();
    if (row.spread >= kWide || steps < kCheap) return Identifiability::open;
    return row.spread <= kNarrow && steps >= 1 ? Identifiability::determined : Identifiability::partly;
  }

  SolutionArchive& archive_;
  Scorer& scorer_;
  std::vector<ParameterIdentifiability> rows_;
  long evaluations_ = 0;
};

}  // namespace

std::string identifiability_name(Identifiability identifiability) {
  constexpr const char* kNames[] = {"determined", "partly", "open", "no effect"};
  return kNames[static_cast<std::size_t>(identifiability)];
}

double ParameterIdentifiability::least_rise() const {
  const double least = std::min(rise_below.value_or(INFINITY), rise_above.value_or(INFINITY));
  return std::isfinite(least) ? least : 0;
}

IdentifiabilityReport measure_identifiability(SolutionArchive& archive, Scorer& scorer, long allowed,
                                              Seed seed) {
  const auto steps = static_cast<long>(2 * archive.space().dimension());
  if (archive.solutions().empty() || steps > allowed) return {};
  return Measurement(archive, scorer).report(allowed, seed);
}

}  // namespace espalier
