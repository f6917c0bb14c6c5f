#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <espalier/image/masks/mask_box.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/reading/clean.h>
#include <espalier/image/reading/picture_faults.h>

namespace espalier {

namespace {

// An edge cuts where at least this share of the tree's extent along it is set on the edge,
constexpr double kLeastContact = 0.06;
constexpr double kWiderThanATrunk = 0.3;  ///< for the lower edge, on which trunks stand
// and at least this share of what is set on a line so much deeper in the picture.
constexpr double kContactOfInside = 0.55, kInsideDepth = 0.04;

// A piece is a tree of its own if it is not too small beside the largest, and stands about as low.
constexpr double kLeastArea = 0.15, kLeastHeight = 0.35, kFootBand = 0.12, kMostOverlap = 0.3;
constexpr double kLooseLeaves = 1.0 / 64;  ///< of the larger side: gaps up to twice this are closed

int set_in_row(const Mask& mask, int y) {
  int count = 0;
  for (int x = 0; x < mask.width_px(); ++x) count += mask.get(x, y);
  return count;
}

int set_in_column(const Mask& mask, int x) {
  int count = 0;
  for (int y = 0; y < mask.height_px(); ++y) count += mask.get(x, y);
  return count;
}

/// on_edge and inside: set pixels of two lines; extent: of the tree along them.
bool is_cut(int on_edge, int inside, int extent, double least_contact) {
  return on_edge >= least_contact * extent && on_edge >= kContactOfInside * inside;
}

/// A foot that spreads on the lower edge is narrower a little above it; a crown that is cut off is not.
bool is_spread_foot(const Mask& mask, int height) {
  constexpr double kFootHeight = 0.2, kNarrower = 0.6;
  const int bottom = mask.height_px() - 1, on_edge = set_in_row(mask, bottom);
  for (int y = bottom; y > bottom - kFootHeight * height && y >= 0; --y)
    if (set_in_row(mask, y) < kNarrower * on_edge) return true;
  return false;
}

void find_cuts(const Mask& mask, PictureFaults& faults) {
  const MaskBox box = box_of(mask);
  const int right = mask.width_px() - 1, bottom = mask.height_px() - 1;
  const int deep_x = std::max(1, static_cast<int>(std::lround(kInsideDepth * mask.width_px())));
  const int deep_y = std::max(1, static_cast<int>(std::lround(kInsideDepth * mask.height_px())));
  const int width = box.width(), height = box.height();
  faults.cut_left = is_cut(set_in_column(mask, 0), set_in_column(mask, deep_x), height, kLeastContact);
  faults.cut_right =
      is_cut(set_in_column(mask, right), set_in_column(mask, right - deep_x), height, kLeastContact);
  faults.cut_top = is_cut(set_in_row(mask, 0), set_in_row(mask, deep_y), width, kLeastContact);
  faults.cut_below =
      is_cut(set_in_row(mask, bottom), set_in_row(mask, bottom - deep_y), width, kWiderThanATrunk) &&
      !is_spread_foot(mask, height);
}

/// Trees in rows, from the upper left as one reads.
using TreeRows = std::vector<std::vector<Mask>>;

using BoxedTree = std::pair<MaskBox, const Mask*>;

/// Rows of trees that stand equally low, the upper first; empty where they do not stand in rows.
std::vector<std::vector<BoxedTree>> grouped_in_rows(std::vector<BoxedTree> trees) {
  std::sort(trees.begin(), trees.end(),
            [](const BoxedTree& a, const BoxedTree& b) { return a.first.bottom < b.first.bottom; });
  std::vector<std::vector<BoxedTree>> rows;
  int row_bottom = 0;
  for (const BoxedTree& tree : trees) {
    const MaskBox& box = tree.first;
    if (rows.empty() || box.top >= row_bottom) {
      rows.emplace_back();
      row_bottom = box.bottom;
    } else if (box.bottom - row_bottom > kFootBand * box.height()) {
      return {};
    }
    rows.back().push_back(tree);
  }
  return rows;
}

/// Pieces of about one size in rows that do not overlap, at least two in one of them: a sheet of sprites.
/// Empty where it is none.
TreeRows rows_of_trees(const std::vector<Mask>& pieces) {
  const MaskBox largest = box_of(pieces.front());
  const double least_area = kLeastArea * static_cast<double>(area_px(pieces.front()));
  std::vector<BoxedTree> trees;
  for (const Mask& piece : pieces) {
    const MaskBox box = box_of(piece);
    if (static_cast<double>(area_px(piece)) >= least_area && box.height() >= kLeastHeight * largest.height())
      trees.emplace_back(box, &piece);
  }
  TreeRows rows;
  bool has_pair = false;
  for (std::vector<BoxedTree>& row : grouped_in_rows(std::move(trees))) {
    std::sort(row.begin(), row.end(),
              [](const BoxedTree& a, const BoxedTree& b) { return a.first.left < b.first.left; });
    has_pair = has_pair || row.size() > 1;
    rows.emplace_back();
    for (const auto& [box, piece] : row) rows.back().push_back(*piece);
  }
  return has_pair && rows.size() > 1 ? rows : TreeRows{};
}

std::vector<Mask> closed_pieces(const Mask& mask) {
  const int side = std::max(mask.width_px(), mask.height_px());
  const Mask closed = close_disc(mask, std::max(1, static_cast<int>(std::lround(kLooseLeaves * side))));
  return separate_pieces(closed, area_px(closed) / 200 + 1);
}

TreeRows rows_in(const Mask& mask) {
  const std::vector<Mask> pieces = closed_pieces(mask);
  return pieces.empty() ? TreeRows{} : rows_of_trees(pieces);
}

/// The trees of a mask, each closed to one piece, the largest first.
std::vector<Mask> trees_in(const Mask& mask) {
  const int side = std::max(mask.width_px(), mask.height_px());
  const Mask closed = close_disc(mask, std::max(1, static_cast<int>(std::lround(kLooseLeaves * side))));
  std::vector<Mask> pieces = separate_pieces(closed, area_px(closed) / 20 + 1);
  if (pieces.empty()) return pieces;
  const MaskBox all = box_of(mask), largest = box_of(pieces.front());
  const double least_area = kLeastArea * static_cast<double>(area_px(pieces.front()));
  const auto is_tree = [&](const Mask& piece) {
    const MaskBox box = box_of(piece);
    const int overlap = std::min(box.right, largest.right) - std::max(box.left, largest.left);
    return static_cast<double>(area_px(piece)) >= least_area && box.height() >= kLeastHeight * all.height() &&
           all.bottom - box.bottom <= kFootBand * all.height() &&
           overlap <= kMostOverlap * std::min(box.width(), largest.width());
  };
  std::vector<Mask> trees{pieces.front()};
  if (all.bottom - largest.bottom > kFootBand * all.height()) return trees;
  for (std::size_t i = 1; i < pieces.size(); ++i)
    if (is_tree(pieces[i])) trees.push_back(std::move(pieces[i]));
  return trees;
}

/// What of a mask stands in the columns of one of its trees and belongs to no other.
Mask alone(const Mask& mask, const Mask& tree, const std::vector<Mask>& trees) {
  const MaskBox box = box_of(tree);
  Mask part(mask.width_px(), mask.height_px());
  for (int y = 0; y < mask.height_px(); ++y)
    for (int x = box.left; x < box.right; ++x) {
      const bool is_others = std::any_of(
          trees.begin(), trees.end(), [&](const Mask& other) { return &other != &tree && other.get(x, y); });
      if (mask.get(x, y) && !is_others) part.set(x, y);
    }
  return part;
}

}  // namespace

PictureFaults picture_faults(const Mask& mask) {
  PictureFaults faults;
  if (area_px(mask) == 0) return faults;
  find_cuts(mask, faults);
  faults.trees = static_cast<int>(trees_in(mask).size());
  if (const TreeRows rows = rows_in(mask); !rows.empty()) {
    faults.rows = static_cast<int>(rows.size());
    faults.trees = 0;
    for (const std::vector<Mask>& row : rows) faults.trees += static_cast<int>(row.size());
  }
  return faults;
}

std::vector<Mask> trees_as_read(const Mask& mask) {
  std::vector<Mask> result;
  if (const TreeRows rows = rows_in(mask); !rows.empty()) {
    for (const std::vector<Mask>& row : rows)
      for (const Mask& tree : row) result.push_back(both(mask, tree));
    return result;
  }
  std::vector<Mask> trees = trees_in(mask);
  if (trees.size() < 2) return {mask};
  std::sort(trees.begin(), trees.end(),
            [](const Mask& a, const Mask& b) { return box_of(a).left < box_of(b).left; });
  for (const Mask& tree : trees) result.push_back(alone(mask, tree, trees));
  return result;
}

Mask largest_tree(const Mask& mask) {
  if (!rows_in(mask).empty()) {
    const std::vector<Mask> trees = trees_as_read(mask);
    return *std::max_element(trees.begin(), trees.end(),
                             [](const Mask& a, const Mask& b) { return area_px(a) < area_px(b); });
  }
  const std::vector<Mask> trees = trees_in(mask);
  if (trees.size() < 2) return mask;
  return alone(mask, trees.front(), trees);
}

std::vector<std::string> describe(const PictureFaults& faults, bool took_largest) {
  std::vector<std::string> lines;
  std::vector<std::string> edges;
  if (faults.cut_left) edges.emplace_back("left");
  if (faults.cut_right) edges.emplace_back("right");
  if (faults.cut_top) edges.emplace_back("upper");
  if (!edges.empty())
    lines.push_back(fmt::format(
        "the tree runs into the {} edge of the picture, as if cut off there: what is in it is fitted",
        fmt::join(edges, " and the ")));
  if (faults.cut_below)
    lines.emplace_back(
        "the tree runs into the lower edge of the picture, and not by its trunk alone: the lower edge is "
        "taken for its foot");
  if (faults.trees > 1)
    lines.push_back(
        fmt::format("there are {} trees in the picture{}: {}", faults.trees,
                    faults.rows > 1 ? fmt::format(", in {} rows", faults.rows) : "",
                    took_largest ? "the largest is fitted, the others are left out (--tree chooses another)"
                                 : "they are fitted as one"));
  return lines;
}

}  // namespace espalier
