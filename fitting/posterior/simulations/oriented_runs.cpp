#include <fmt/format.h>

#include <array>
#include <bit>
#include <utility>

#include <espalier/core/error.h>
#include <espalier/fitting/posterior/simulations/oriented_runs.h>
#include <espalier/fitting/posterior/simulations/silhouette_summaries.h>
#include <espalier/fitting/posterior/simulations/summary_bands.h>
#include <espalier/image/masks/row_runs.h>

namespace espalier {

namespace {

constexpr std::array<int, 3> kLengthsPx{2, 3, 5};

/// Bits moved to higher columns, or lower ones; what leaves the row is lost. |columns| < 64.
void move_row(std::span<const std::uint64_t> from, int columns, std::span<std::uint64_t> to) {
  const std::size_t words = from.size();
  for (std::size_t i = 0; i < words; ++i) {
    if (columns == 0) to[i] = from[i];
    if (columns > 0) to[i] = from[i] << columns | (i > 0 ? from[i - 1] >> (64 - columns) : 0);
    if (columns < 0) to[i] = from[i] >> -columns | (i + 1 < words ? from[i + 1] << (64 + columns) : 0);
  }
}

/// Pixels dx columns to the right and dy rows down; those that leave the mask are lost.
Mask moved(const Mask& mask, int dx, int dy) {
  Mask result(mask.width_px(), mask.height_px());
  for (int y = 0; y < mask.height_px(); ++y)
    if (y - dy >= 0 && y - dy < mask.height_px()) move_row(mask.row(y - dy), dx, result.row(y));
  if (const int used = mask.width_px() & 63; used != 0)
    for (int y = 0; y < mask.height_px(); ++y) result.row(y).back() &= (std::uint64_t{1} << used) - 1;
  return result;
}

/// What is not set between the first and the last set pixel of each row.
Mask gaps_of(const Mask& mask, const MaskBox& box) {
  Mask gaps(mask.width_px(), mask.height_px());
  for (int y = box.top; y < box.bottom; ++y) {
    const std::vector<RowRun> runs = runs_of(mask, y);
    for (std::size_t i = 1; i < runs.size(); ++i)
      for (int x = runs[i - 1].last + 1; x < runs[i].first; ++x) gaps.set(x, y);
  }
  return gaps;
}

/// Set pixels of a tier in the left and in the right half of the frame: each half of a row is one word.
struct Halves {
  double left = 0, right = 0;
};

static_assert(kSummaryFramePx == 128);

Halves count_halves(const Mask& mask, Band rows) {
  Halves halves;
  for (int y = rows.first; y < rows.end; ++y) {
    halves.left += std::popcount(mask.row(y)[0]);
    halves.right += std::popcount(mask.row(y)[1]);
  }
  return halves;
}

using TierShares = std::array<double, kTiers>;

/// One over the pixels between the rows' ends, and one more, so that a tier may be empty.
TierShares shares_of_pixels(const Mask& mask, const MaskBox& box) {
  TierShares shares;
  for (int tier = 0; tier < kTiers; ++tier) {
    const Band rows = band_of(box, tier, kTiers);
    double pixels = 1;
    for (int y = rows.first; y < rows.end; ++y) pixels += row_extent_px(mask, y);
    shares[static_cast<std::size_t>(tier)] = 1 / pixels;
  }
  return shares;
}

/// Of a mask of pieces, or of gaps. A run up to the right leads away from the trunk in the right half, and
/// towards it in the left one.
void add_runs(const Mask& parts, const MaskBox& box, const TierShares& shares,
              std::vector<double>& summaries) {
  for (const int length_px : kLengthsPx) {
    const Mask level = on_runs(parts, length_px, 1, 0), upright = on_runs(parts, length_px, 0, 1),
               up_right = on_runs(parts, length_px, 1, -1), up_left = on_runs(parts, length_px, -1, -1);
    for (int tier = 0; tier < kTiers; ++tier) {
      const Band rows = band_of(box, tier, kTiers);
      const Halves of_level = count_halves(level, rows), of_upright = count_halves(upright, rows),
                   of_up_right = count_halves(up_right, rows), of_up_left = count_halves(up_left, rows);
      for (const double count : {of_level.left + of_level.right, of_upright.left + of_upright.right,
                                 of_up_right.right + of_up_left.left, of_up_right.left + of_up_left.right})
        summaries.push_back(count * shares[static_cast<std::size_t>(tier)]);
    }
  }
}

}  // namespace

Mask on_runs(const Mask& mask, int length_px, int dx, int dy) {
  Mask starts = mask;
  for (int i = 1; i < length_px; ++i) starts = both(std::move(starts), moved(mask, -i * dx, -i * dy));
  Mask runs = starts;
  for (int i = 1; i < length_px; ++i) runs = either(std::move(runs), moved(starts, i * dx, i * dy));
  return runs;
}

void add_oriented_runs(const Mask& mask, const MaskBox& box, std::vector<double>& summaries) {
  ESPALIER_CHECK_EQ(mask.width_px(), kSummaryFramePx);
  const TierShares shares = shares_of_pixels(mask, box);
  add_runs(mask, box, shares, summaries);
  add_runs(gaps_of(mask, box), box, shares, summaries);
}

void name_oriented_runs(std::vector<std::string>& names) {
  for (const char* parts : {"pieces", "gaps"})
    for (const int length_px : kLengthsPx)
      for (int tier = 0; tier < kTiers; ++tier)
        for (const char* direction : {"level", "upright", "outward", "inward"})
          names.push_back(fmt::format("{} {} px {} {}", direction, length_px, parts, tier + 1));
}

}  // namespace espalier
