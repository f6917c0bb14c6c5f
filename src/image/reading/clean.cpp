#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

#include <espalier/image/masks/morphology.h>
#include <espalier/image/reading/clean.h>

namespace espalier {

namespace {

/// A run of set pixels of one row: x in [begin, end).
struct LabelledRun {
  int y, begin, end;
};

std::vector<LabelledRun> find_runs(const Mask& mask) {
  std::vector<LabelledRun> runs;
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x) {
      if (!mask.get(x, y)) continue;
      const int begin = x;
      while (x < mask.width_px() && mask.get(x, y)) ++x;
      runs.push_back({y, begin, x});
    }
  return runs;
}

/// Disjoint sets of runs (Tarjan 1975), with path halving.
class RunSets {
 public:
  explicit RunSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::size_t find(std::size_t run) {
    while (parent_[run] != run) run = parent_[run] = parent_[parent_[run]];
    return run;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Joins each run with those of the row above that touch it; `slack` is 1 where corners touch.
RunSets join_touching(const std::vector<LabelledRun>& runs, int slack) {
  RunSets sets(runs.size());
  std::size_t above = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const LabelledRun& run = runs[i];
    while (above < i && (runs[above].y < run.y - 1 ||
                         (runs[above].y == run.y - 1 && runs[above].end + slack <= run.begin)))
      ++above;
    for (std::size_t j = above; j < i && runs[j].y == run.y - 1 && runs[j].begin < run.end + slack; ++j)
      sets.join(i, j);
  }
  return sets;
}

}  // namespace

Mask large_pieces(const Mask& mask, std::size_t min_area_px, Connectivity connectivity) {
  const std::vector<LabelledRun> runs = find_runs(mask);
  RunSets sets = join_touching(runs, connectivity == Connectivity::eight ? 1 : 0);
  std::vector<std::size_t> area_px(runs.size(), 0);
  for (std::size_t i = 0; i < runs.size(); ++i)
    area_px[sets.find(i)] += static_cast<std::size_t>(runs[i].end - runs[i].begin);
  Mask large(mask.width_px(), mask.height_px());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (area_px[sets.find(i)] < min_area_px) continue;
    for (int x = runs[i].begin; x < runs[i].end; ++x) large.set(x, runs[i].y);
  }
  return large;
}

std::vector<Mask> separate_pieces(const Mask& mask, std::size_t min_area_px, Connectivity connectivity) {
  const std::vector<LabelledRun> runs = find_runs(mask);
  RunSets sets = join_touching(runs, connectivity == Connectivity::eight ? 1 : 0);
  std::map<std::size_t, std::vector<LabelledRun>> runs_of;
  for (std::size_t i = 0; i < runs.size(); ++i) runs_of[sets.find(i)].push_back(runs[i]);
  std::vector<Mask> pieces;
  for (const auto& [set, members] : runs_of) {
    std::size_t area = 0;
    for (const LabelledRun& run : members) area += static_cast<std::size_t>(run.end - run.begin);
    if (area < min_area_px) continue;
    pieces.emplace_back(mask.width_px(), mask.height_px());
    for (const LabelledRun& run : members)
      for (int x = run.begin; x < run.end; ++x) pieces.back().set(x, run.y);
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Mask& a, const Mask& b) { return area_px(a) > area_px(b); });
  return pieces;
}

Mask remove_specks(const Mask& mask, std::size_t speck_px) {
  const int reach_px = std::max(1, std::max(mask.width_px(), mask.height_px()) / 64);
  const Mask large = large_pieces(mask, speck_px, Connectivity::eight);
  return both(mask, dilate_disc(large, reach_px));
}

Mask fill_pinholes(const Mask& mask, std::size_t pinhole_px) {
  const Mask holes = both(fill_holes(mask), complement(mask));
  const Mask large = large_pieces(holes, pinhole_px, Connectivity::four);
  return either(mask, both(holes, complement(large)));
}

std::size_t default_speck_px(int width_px, int height_px) {
  return std::max<std::size_t>(4, static_cast<std::size_t>(width_px) * height_px / 20'000);
}

}  // namespace espalier
