#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include <espalier/image/marks/lines.h>
#include <espalier/image/marks/marks.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/masks/pieces.h>
#include <espalier/image/masks/row_runs.h>

namespace espalier {

namespace {

constexpr double kLooseLeaves = 1.0 / 64;  ///< of the larger side: gaps up to twice this are within a tree
constexpr double kTreeArea = 0.15;  ///< of the largest: what is as large belongs to the picture's subject
constexpr double kNearTree = 0.08;  ///< of its height: pieces as near to it may be its foliage
constexpr double kBarShape = 8;     ///< a scale bar is as many times longer than high
constexpr double kLeastBar = 0.1;   ///< of the tree's width, where it is at the tree's foot
constexpr int kLeastLetters = 2;
constexpr double kFootBand = 0.08;  ///< of the tree's height: persons stand as low as it
constexpr double kTallerThanWide = 1.3;

/// Rows and columns between the first and the last set pixel of a tree.
class Extents {
 public:
  explicit Extents(const MaskPiece& tree, int width_px, int height_px)
      : rows_(height_px, Range{width_px, -1}), columns_(width_px, Range{height_px, -1}) {
    for (const PieceRun& run : tree.runs) {
      rows_[run.y] = {std::min(rows_[run.y].first, run.begin), std::max(rows_[run.y].last, run.end - 1)};
      for (int x = run.begin; x < run.end; ++x)
        columns_[x] = {std::min(columns_[x].first, run.y), std::max(columns_[x].last, run.y)};
    }
  }

  /// Whether the tree is on both sides of the place, along its row or its column.
  bool surround(int x, int y) const {
    return (rows_[y].first <= x && x <= rows_[y].last) || (columns_[x].first <= y && y <= columns_[x].last);
  }

 private:
  struct Range {
    int first, last;
  };
  std::vector<Range> rows_, columns_;
};

void erase(const MaskPiece& piece, Mask& mask) {
  for (const PieceRun& run : piece.runs)
    for (int x = run.begin; x < run.end; ++x) mask.set(x, run.y, false);
}

std::size_t set_area(const Mask& mask, const MaskPiece& cluster) {
  std::size_t area = 0;
  for (const PieceRun& run : cluster.runs)
    for (int x = run.begin; x < run.end; ++x) area += mask.get(x, run.y);
  return area;
}

/// What is set of a mask in a cluster, as pieces.
std::vector<MaskPiece> parts_of(const Mask& mask, const MaskPiece& cluster) {
  Mask part(mask.width_px(), mask.height_px());
  for (const PieceRun& run : cluster.runs)
    for (int x = run.begin; x < run.end; ++x)
      if (mask.get(x, run.y)) part.set(x, run.y);
  return pieces_of(part);
}

bool is_bar(const MaskPiece& part) {
  return part.box.width() >= kBarShape * part.box.height() &&
         2 * part.area_px >= static_cast<std::size_t>(part.box.width()) * part.box.height();
}

MarkKind kind_of(const std::vector<MaskPiece>& parts, const MaskBox& box, const MaskBox& tree) {
  if (is_bar(parts.front())) return MarkKind::scale_bar;
  const bool is_wide = box.width() > box.height();
  if (static_cast<int>(parts.size()) >= kLeastLetters && is_wide) return MarkKind::caption;
  const bool stands_low = std::abs(box.bottom - tree.bottom) <= kFootBand * tree.height();
  if (stands_low && box.height() >= kTallerThanWide * box.width()) return MarkKind::figure;
  return MarkKind::piece;
}

bool is_wanted(MarkKind kind, const MarkChoice& choice) {
  switch (kind) {
    case MarkKind::line:
    case MarkKind::frame:
      return choice.lines;
    case MarkKind::caption:
    case MarkKind::scale_bar:
      return choice.captions;
    default:
      return choice.figures;
  }
}

/// Whether a piece lies over the tree's foot, within its box or little outside of it.
bool is_near(const MaskBox& piece, const MaskBox& tree) {
  const int reach = tree.rows(kNearTree);
  return piece.left >= tree.left - reach && piece.right <= tree.right + reach &&
         piece.top >= tree.top - reach && piece.bottom <= tree.bottom;
}

/// Of the first part and all others.
void add_bar_and_letters(const std::vector<MaskPiece>& parts, std::vector<Mark>& marks) {
  marks.push_back({MarkKind::scale_bar, parts.front().box});
  if (parts.size() == 1) return;
  MaskBox letters = parts[1].box;
  for (std::size_t i = 2; i < parts.size(); ++i) letters = joined(letters, parts[i].box);
  marks.push_back({MarkKind::caption, letters, static_cast<int>(parts.size()) - 1});
}

/// Beside letters may be a bar: each is a mark of its own.
void add_marks(const std::vector<MaskPiece>& parts, const MaskPiece& cluster, const MaskBox& tree,
               std::vector<Mark>& marks) {
  const MarkKind kind = kind_of(parts, cluster.box, tree);
  if (kind == MarkKind::scale_bar && parts.size() > 1) {
    add_bar_and_letters(parts, marks);
    return;
  }
  marks.push_back(
      {kind, kind == MarkKind::scale_bar ? parts.front().box : cluster.box, static_cast<int>(parts.size())});
}

void take_lines(MarkedMask& marked) {
  const FoundLines lines = find_lines(marked.tree);
  if (lines.rows.empty() && lines.columns.empty()) return;
  const Mask rest = without(marked.tree, lines.pixels);
  if (area_px(rest) == 0) return;
  marked.tree = rest;
  if (!lines.columns.empty()) {
    MaskBox box = lines.columns.front();
    for (const auto* group : {&lines.rows, &lines.columns})
      for (const MaskBox& line : *group) box = joined(box, line);
    marked.marks.push_back(
        {MarkKind::frame, box, static_cast<int>(lines.rows.size() + lines.columns.size())});
    return;
  }
  for (const MaskBox& line : lines.rows) marked.marks.push_back({MarkKind::line, line});
}

/// Clusters of pieces as near to each other as leaves, the one with the most pixels first.
std::vector<MaskPiece> clusters_of(const Mask& mask) {
  const int side = std::max(mask.width_px(), mask.height_px());
  std::vector<MaskPiece> clusters =
      pieces_of(close_disc(mask, std::max(1, static_cast<int>(std::lround(kLooseLeaves * side)))));
  for (MaskPiece& cluster : clusters) cluster.area_px = set_area(mask, cluster);
  std::stable_sort(clusters.begin(), clusters.end(),
                   [](const MaskPiece& a, const MaskPiece& b) { return a.area_px > b.area_px; });
  return clusters;
}

void take_pieces(const MarkChoice& choice, MarkedMask& marked) {
  if (pieces_of(marked.tree).size() < 2) return;
  const Mask mask = marked.tree;
  const std::vector<MaskPiece> clusters = clusters_of(mask);
  const MaskPiece& tree = clusters.front();
  const Extents extents(tree, mask.width_px(), mask.height_px());
  const auto is_apart = [&](const MaskPiece& cluster) {
    const bool is_large =
        static_cast<double>(cluster.area_px) >= kTreeArea * static_cast<double>(tree.area_px);
    return !is_large && !extents.surround((cluster.box.left + cluster.box.right) / 2,
                                          (cluster.box.top + cluster.box.bottom) / 2);
  };
  for (std::size_t i = 1; i < clusters.size(); ++i) {
    const MaskPiece& cluster = clusters[i];
    if (!is_apart(cluster)) continue;
    const std::vector<MaskPiece> parts = parts_of(mask, cluster);
    if (parts.empty()) continue;  // closing reaches beyond what it closes at the picture's edges
    const MarkKind kind = kind_of(parts, cluster.box, tree.box);
    if (!is_wanted(kind, choice) || (kind == MarkKind::piece && is_near(cluster.box, tree.box))) continue;
    add_marks(parts, cluster, tree.box, marked.marks);
    erase(cluster, marked.tree);
  }
}

/// A bar wholly below the tree, too near to its foot to be a cluster of its own, and what stands as low.
void take_bar_below(MarkedMask& marked) {
  const std::vector<MaskPiece> pieces = pieces_of(marked.tree);
  if (pieces.size() < 2) return;
  const MaskBox& tree = pieces.front().box;
  const auto bar = std::find_if(pieces.begin() + 1, pieces.end(), [&](const MaskPiece& piece) {
    return piece.box.top >= tree.bottom && piece.box.width() >= kBarShape * piece.box.height() &&
           piece.box.width() >= kLeastBar * tree.width();
  });
  if (bar == pieces.end()) return;
  std::vector<MaskPiece> parts{*bar};
  for (const MaskPiece& piece : pieces)
    if (piece.box.top >= bar->box.top && &piece != &*bar) parts.push_back(piece);
  add_bar_and_letters(parts, marked.marks);
  for (const MaskPiece& part : parts) erase(part, marked.tree);
}

std::string describe(const Mark& mark) {
  const MaskBox& box = mark.box;
  const std::string place = fmt::format("at {},{}", box.left, box.top);
  switch (mark.kind) {
    case MarkKind::line:
      return fmt::format("a line {} px long {}", box.width(), place);
    case MarkKind::frame:
      return fmt::format("a frame of {} lines, {}×{} px", mark.parts, box.width(), box.height());
    case MarkKind::caption:
      return fmt::format("a caption of {} pieces {}", mark.parts, place);
    case MarkKind::scale_bar:
      return fmt::format("a scale bar {} px long {} (--scale-bar {}=METRES)", box.width(), place,
                         box.width());
    case MarkKind::figure:
      return fmt::format("a figure {} px tall {}", box.height(), place);
    case MarkKind::piece:
      return fmt::format("a piece of {}×{} px {}", box.width(), box.height(), place);
  }
  return "";
}

}  // namespace

MarkedMask without_marks(const Mask& mask, const MarkChoice& choice) {
  MarkedMask marked{mask, {}};
  if (choice.lines) take_lines(marked);
  take_pieces(choice, marked);
  if (choice.captions) take_bar_below(marked);
  return marked;
}

std::vector<std::string> describe(const std::vector<Mark>& marks) {
  constexpr std::size_t kMostTold = 8;
  std::vector<std::string> lines;
  for (const Mark& mark : marks) {
    if (lines.size() == kMostTold) {
      lines.push_back(fmt::format("and {} more", marks.size() - kMostTold));
      break;
    }
    lines.push_back(describe(mark));
  }
  return lines;
}

}  // namespace espalier
