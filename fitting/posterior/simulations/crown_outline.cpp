#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include <espalier/fitting/posterior/simulations/crown_outline.h>
#include <espalier/fitting/posterior/simulations/summary_bands.h>
#include <espalier/image/masks/row_runs.h>

namespace espalier {

namespace {

constexpr std::size_t kRings = 4;

/// Columns of a row's first and last set pixel.
struct RowEnds {
  int first = 0, last = -1;

  bool is_empty() const { return last < first; }
  int width() const { return last - first + 1; }
};

/// Of all rows of the mask.
std::vector<RowEnds> ends_of_rows(const Mask& mask) {
  std::vector<RowEnds> ends(static_cast<std::size_t>(mask.height_px()));
  for (int y = 0; y < mask.height_px(); ++y)
    if (const std::vector<RowRun> runs = runs_of(mask, y); !runs.empty())
      ends[static_cast<std::size_t>(y)] = {runs.front().first, runs.back().last};
  return ends;
}

/// Ring 0 is around the middle of the row.
std::size_t ring_of(int x, const RowEnds& ends) {
  const int from_middle = std::abs(2 * x - ends.first - ends.last);  // in halves of pixels, below the width
  return kRings * static_cast<std::size_t>(from_middle) / static_cast<std::size_t>(ends.width());
}

void add_rings(const Mask& mask, const std::vector<RowEnds>& ends, Band rows,
               std::vector<double>& summaries) {
  std::array<double, kRings> set{}, all{};
  for (int y = rows.first; y < rows.end; ++y) {
    const RowEnds& row = ends[static_cast<std::size_t>(y)];
    for (int x = row.first; x <= row.last; ++x) {
      const std::size_t ring = ring_of(x, row);
      all[ring] += 1;
      set[ring] += mask.get(x, y) ? 1 : 0;
    }
  }
  for (std::size_t ring = 0; ring < kRings; ++ring) summaries.push_back(set[ring] / (all[ring] + 1));
}

void add_steps_and_lean(const Mask& mask, const MaskBox& box, const std::vector<RowEnds>& ends, Band rows,
                        std::vector<double>& summaries) {
  double steps = 0, lean = 0, count = 1;
  for (int y = rows.first; y < rows.end; ++y) {
    const RowEnds& row = ends[static_cast<std::size_t>(y)];
    if (row.is_empty()) continue;
    count += 1;
    lean += std::abs(row.first + row.last + 1 - mask.width_px());
    if (y == 0 || ends[static_cast<std::size_t>(y - 1)].is_empty()) continue;
    const RowEnds& above = ends[static_cast<std::size_t>(y - 1)];
    steps += std::abs(row.first - above.first) + std::abs(row.last - above.last);
  }
  summaries.push_back(std::log1p(steps / count));
  summaries.push_back(lean / count / box.height());
}

double width_deviation(const std::vector<RowEnds>& ends, Band rows) {
  double sum = 0, squares = 0;
  for (int y = rows.first; y < rows.end; ++y) {
    const double width = ends[static_cast<std::size_t>(y)].width();
    sum += width;
    squares += width * width;
  }
  const double mean = sum / rows.rows();
  return std::sqrt(std::max(0.0, squares / rows.rows() - mean * mean));
}

}  // namespace

void add_crown_outline(const Mask& mask, const MaskBox& box, std::vector<double>& summaries) {
  const std::vector<RowEnds> ends = ends_of_rows(mask);
  for (int tier = 0; tier < kTiers; ++tier) {
    const Band rows = band_of(box, tier, kTiers);
    add_rings(mask, ends, rows, summaries);
    add_steps_and_lean(mask, box, ends, rows, summaries);
  }
  for (int height = 0; height < kHeights; ++height)
    summaries.push_back(width_deviation(ends, band_of(box, height, kHeights)) / box.height());
}

void name_crown_outline(std::vector<std::string>& names) {
  for (int tier = 1; tier <= kTiers; ++tier) {
    for (std::size_t ring = 1; ring <= kRings; ++ring)
      names.push_back(fmt::format("ring {} cover {}", ring, tier));
    names.push_back(fmt::format("steps {}", tier));
    names.push_back(fmt::format("lean {}", tier));
  }
  for (int height = 1; height <= kHeights; ++height)
    names.push_back(fmt::format("width spread {:02}", height));
}

}  // namespace espalier
