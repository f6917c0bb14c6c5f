#include <cmath>

#include <espalier/image/masks/morphology.h>

namespace espalier {

namespace {

using Row = std::span<std::uint64_t>;
using ConstRow = std::span<const std::uint64_t>;

/// The bits of a row's last word that are pixels.
std::uint64_t last_word_bits(const Mask& mask) {
  const int used = mask.width_px() & 63;
  return used == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << used) - 1;
}

void clear_padding(Mask& mask) {
  if (mask.words_per_row() == 0) return;
  const std::uint64_t used = last_word_bits(mask);
  for (int y = 0; y < mask.height_px(); ++y) mask.row(y).back() &= used;
}

/// to |= the pixels of `from` and their left and right neighbours.
void or_with_neighbours(Row to, ConstRow from) {
  const std::size_t count = from.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t right = i > 0 ? from[i - 1] >> 63 : 0;
    const std::uint64_t left = i + 1 < count ? from[i + 1] << 63 : 0;
    to[i] |= from[i] | (from[i] << 1) | right | (from[i] >> 1) | left;
  }
}

void or_row(Row to, ConstRow from) {
  for (std::size_t i = 0; i < from.size(); ++i) to[i] |= from[i];
}

/// How far the disc reaches sideways, `dy` rows from its centre.
int half_width(int radius_px, int dy) {
  return static_cast<int>(std::sqrt(static_cast<double>(radius_px * radius_px - dy * dy)));
}

/// Spreads seeds to higher bits through free bits: the carry of an addition runs along a run of ones.
void spread_up(Row seeds, ConstRow free) {
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const std::uint64_t partial = free[i] + seeds[i], sum = partial + carry;
    carry = (partial < free[i]) | (sum < partial);
    seeds[i] |= free[i] & ~sum;
  }
}

/// Spreads seeds to lower bits through free bits, in doubling steps (Kogge, Stone 1973).
void spread_down(Row seeds, ConstRow free) {
  std::uint64_t enters = 0;
  for (std::size_t i = free.size(); i-- > 0;) {
    std::uint64_t through = free[i], filled = seeds[i] | (enters & through);
    for (int step = 1; step < 64; step *= 2) {
      filled |= (filled >> step) & through;
      through &= through >> step;
    }
    seeds[i] = filled;
    enters = filled << 63;
  }
}

/// Lets the flood of row `from` enter row `to`. Returns whether it gained pixels.
bool flood_row(Row to, ConstRow from, ConstRow free) {
  bool entered = false;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const std::uint64_t seeds = from[i] & free[i] & ~to[i];
    to[i] |= seeds;
    entered |= seeds != 0;
  }
  if (!entered) return false;
  spread_up(to, free);
  spread_down(to, free);
  return true;
}

/// Floods `free` from its pixels on the border of the picture.
Mask flood_from_border(const Mask& free) {
  const int rows = free.height_px(), last_x = free.width_px() - 1;
  Mask flood(free.width_px(), rows);
  for (int y = 0; y < rows; ++y) {
    if (y == 0 || y == rows - 1) or_row(flood.row(y), free.row(y));
    if (free.get(0, y)) flood.set(0, y);
    if (free.get(last_x, y)) flood.set(last_x, y);
    spread_up(flood.row(y), free.row(y));
    spread_down(flood.row(y), free.row(y));
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (int y = 1; y < rows; ++y) changed |= flood_row(flood.row(y), flood.row(y - 1), free.row(y));
    for (int y = rows - 1; y-- > 0;) changed |= flood_row(flood.row(y), flood.row(y + 1), free.row(y));
  }
  return flood;
}

}  // namespace

Mask complement(const Mask& mask) {
  Mask result = mask;
  for (std::uint64_t& word : result.words()) word = ~word;
  clear_padding(result);
  return result;
}

void dilate_plus(const Mask& mask, Mask& result) {
  result.reset(mask.width_px(), mask.height_px());
  for (int y = 0; y < mask.height_px(); ++y) {
    or_with_neighbours(result.row(y), mask.row(y));
    if (y > 0) or_row(result.row(y), mask.row(y - 1));
    if (y + 1 < mask.height_px()) or_row(result.row(y), mask.row(y + 1));
  }
  clear_padding(result);
}

void dilate_square(const Mask& mask, Mask& result) {
  result.reset(mask.width_px(), mask.height_px());
  for (int y = 0; y < mask.height_px(); ++y) {
    or_with_neighbours(result.row(y), mask.row(y));
    if (y > 0) or_with_neighbours(result.row(y), mask.row(y - 1));
    if (y + 1 < mask.height_px()) or_with_neighbours(result.row(y), mask.row(y + 1));
  }
  clear_padding(result);
}

Mask dilate_disc(const Mask& mask, int radius_px) {
  Mask result = mask, widened = mask, previous = mask;
  int reach = 0;
  for (int dy = radius_px; dy >= 0; --dy) {
    for (; reach < half_width(radius_px, dy); ++reach) {
      for (int y = 0; y < mask.height_px(); ++y) or_with_neighbours(widened.row(y), previous.row(y));
      clear_padding(widened);
      previous = widened;
    }
    for (int y = 0; y + dy < mask.height_px(); ++y) {
      or_row(result.row(y), widened.row(y + dy));
      or_row(result.row(y + dy), widened.row(y));
    }
  }
  return result;
}

Mask erode_disc(const Mask& mask, int radius_px) {
  return complement(dilate_disc(complement(mask), radius_px));
}

Mask close_disc(const Mask& mask, int radius_px) {
  return erode_disc(dilate_disc(mask, radius_px), radius_px);
}

Mask fill_holes(const Mask& mask) {
  if (mask.width_px() == 0 || mask.height_px() == 0) return mask;
  return complement(flood_from_border(complement(mask)));
}

}  // namespace espalier
