#include <algorithm>
#include <limits>
#include <numeric>

#include <espalier/image/masks/pieces.h>

namespace espalier {

namespace {

std::vector<PieceRun> runs_in(const Mask& mask) {
  std::vector<PieceRun> runs;
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x) {
      if (!mask.get(x, y)) continue;
      const int begin = x;
      while (x < mask.width_px() && mask.get(x, y)) ++x;
      runs.push_back({y, begin, x});
    }
  return runs;
}

std::size_t root_of(std::vector<std::size_t>& parents, std::size_t run) {
  while (parents[run] != run) run = parents[run] = parents[parents[run]];
  return run;
}

/// For each run, the first run of its piece (Tarjan 1975); `slack` is 1 where pixels touch by corners.
std::vector<std::size_t> roots_of_runs(const std::vector<PieceRun>& runs, int slack) {
  std::vector<std::size_t> parents(runs.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  std::size_t above = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PieceRun& run = runs[i];
    while (above < i && (runs[above].y < run.y - 1 ||
                         (runs[above].y == run.y - 1 && runs[above].end + slack <= run.begin)))
      ++above;
    for (std::size_t j = above; j < i && runs[j].y == run.y - 1 && runs[j].begin < run.end + slack; ++j) {
      const std::size_t a = root_of(parents, i), b = root_of(parents, j);
      parents[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::size_t i = 0; i < runs.size(); ++i) parents[i] = root_of(parents, i);
  return parents;
}

void add_run(const PieceRun& run, MaskPiece& piece) {
  if (piece.runs.empty()) piece.box = {run.begin, run.end, run.y, run.y + 1};
  piece.box.left = std::min(piece.box.left, run.begin);
  piece.box.right = std::max(piece.box.right, run.end);
  piece.box.bottom = run.y + 1;
  piece.area_px += static_cast<std::size_t>(run.end - run.begin);
  piece.runs.push_back(run);
}

}  // namespace

std::vector<MaskPiece> pieces_of(const Mask& mask, Connectivity connectivity) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  const std::vector<PieceRun> runs = runs_in(mask);
  const std::vector<std::size_t> roots = roots_of_runs(runs, connectivity == Connectivity::eight ? 1 : 0);
  std::vector<std::size_t> piece_of(runs.size(), kNone);
  std::vector<MaskPiece> pieces;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::size_t& piece = piece_of[roots[i]];
    if (piece == kNone) {
      piece = pieces.size();
      pieces.emplace_back();
    }
    add_run(runs[i], pieces[piece]);
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const MaskPiece& a, const MaskPiece& b) { return a.area_px > b.area_px; });
  return pieces;
}

void set_pixels(const MaskPiece& piece, Mask& mask) {
  for (const PieceRun& run : piece.runs)
    for (int x = run.begin; x < run.end; ++x) mask.set(x, run.y);
}

}  // namespace espalier
