#include <algorithm>

#include <espalier/image/masks/row_runs.h>

namespace espalier {

std::vector<RowRun> runs_of(const Mask& mask, int y) {
  std::vector<RowRun> runs;
  for (int x = 0; x < mask.width_px(); ++x) {
    if (!mask.get(x, y)) continue;
    if (runs.empty() || runs.back().last != x - 1) runs.push_back({x, x - 1});
    runs.back().last = x;
  }
  return runs;
}

RowRun widest_run(const Mask& mask, int y) {
  const std::vector<RowRun> runs = runs_of(mask, y);
  const auto widest = std::max_element(
      runs.begin(), runs.end(), [](const RowRun& a, const RowRun& b) { return a.width() < b.width(); });
  return widest == runs.end() ? RowRun{} : *widest;
}

int extent_px(const Mask& mask, int first, int end) {
  int left = mask.width_px(), right = 0;
  for (int y = first; y < end; ++y)
    for (const RowRun& run : runs_of(mask, y)) {
      left = std::min(left, run.first);
      right = std::max(right, run.last + 1);
    }
  return std::max(0, right - left);
}

}  // namespace espalier
