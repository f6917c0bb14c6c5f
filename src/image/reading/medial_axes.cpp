#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include <espalier/image/masks/distance_field.h>
#include <espalier/image/masks/morphology.h>
#include <espalier/image/reading/medial_axes.h>

namespace espalier {

namespace {

constexpr float kBandPx = 2;

float distance_px(PixelPoint a, PixelPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

float length_px(const std::vector<PixelPoint>& line) {
  float length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += distance_px(line[i - 1], line[i]);
  return length;
}

struct Step {
  int dx, dy;
  float length_px;
};
constexpr Step kSteps[] = {{-1, 0, 1},         {1, 0, 1},         {0, -1, 1},        {0, 1, 1},
                           {-1, -1, 1.41421f}, {1, -1, 1.41421f}, {-1, 1, 1.41421f}, {1, 1, 1.41421f}};

/// Distances from the lowest row along paths inside of the mask, and the pixel before on each path.
class DistanceFromFoot {
 public:
  explicit DistanceFromFoot(const Mask& mask)
      : width_(mask.width_px()),
        height_(mask.height_px()),
        distance_(size(), std::numeric_limits<float>::infinity()),
        before_(size(), -1) {
    start_from_lowest_row(mask);
    while (!open_.empty()) settle_next(mask);
  }

  int index(int x, int y) const { return y * width_ + x; }
  PixelPoint point(int pixel) const {
    const int x = pixel % width_, y = pixel / width_;
    return {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
  }
  /// Band of the pixel; -1 where no path leads.
  int band(int pixel) const {
    const float distance = distance_[static_cast<std::size_t>(pixel)];
    return std::isfinite(distance) ? static_cast<int>(distance / kBandPx) : -1;
  }
  int before(int pixel) const { return before_[static_cast<std::size_t>(pixel)]; }
  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }

 private:
  void start_from_lowest_row(const Mask& mask) {
    for (int y = height_ - 1; y >= 0 && open_.empty(); --y)
      for (int x = 0; x < width_; ++x)
        if (mask.get(x, y)) reach(index(x, y), 0, -1);
  }

  void reach(int pixel, float distance, int from) {
    float& known = distance_[static_cast<std::size_t>(pixel)];
    if (distance >= known) return;
    known = distance;
    before_[static_cast<std::size_t>(pixel)] = from;
    open_.push({distance, pixel});
  }

  void settle_next(const Mask& mask) {
    const auto [distance, pixel] = open_.top();
    open_.pop();
    if (distance > distance_[static_cast<std::size_t>(pixel)]) return;
    const int x = pixel % width_, y = pixel / width_;
    for (const Step& step : kSteps) {
      const int to_x = x + step.dx, to_y = y + step.dy;
      if (to_x < 0 || to_y < 0 || to_x >= width_ || to_y >= height_ || !mask.get(to_x, to_y)) continue;
      reach(index(to_x, to_y), distance + step.length_px, pixel);
    }
  }

  using Entry = std::pair<float, int>;
  int width_, height_;
  std::vector<float> distance_;
  std::vector<int> before_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

/// A connected piece of a band: one cut across a branch.
struct Piece {
  PixelPoint middle;
  int pixels = 0;
  int below = -1;  ///< the piece it grows out of
  std::vector<int> above;
  float width_px = 0;
  float reach_px = 0;  ///< of the longest line from here to a tip
  int levels = 1;      ///< of branching that the axes from here on need at least
  int on = -1;         ///< the piece above that goes on along the axis
};

/// All pieces, each after the one below it. Their middles are where the mask is widest, by `free_px`, the
/// distances of pixels to its edge: a branch that is about to leave does not draw the middle aside.
class Pieces {
 public:
  Pieces(const DistanceFromFoot& field, const std::vector<float>& free_px)
      : field_(field), free_px_(free_px), piece_of_(field.size(), -1) {
    collect();
    link();
  }
  std::vector<Piece> all;

 private:
  void collect() {
    std::vector<std::pair<int, int>> by_band;  // so that pieces come from the foot up
    for (int pixel = 0; pixel < static_cast<int>(field_.size()); ++pixel)
      if (field_.band(pixel) >= 0) by_band.push_back({field_.band(pixel), pixel});
    std::sort(by_band.begin(), by_band.end());
    for (const auto& entry : by_band)
      if (piece_of_[static_cast<std::size_t>(entry.second)] < 0) flood(entry.second);
  }

  void flood(int first) {
    const int number = static_cast<int>(all.size());
    Piece piece;
    float weights = 0;
    std::vector<int> open{first};
    piece_of_[static_cast<std::size_t>(first)] = number;
    while (!open.empty()) {
      const int pixel = open.back();
      open.pop_back();
      const PixelPoint at = field_.point(pixel);
      const float free_px = std::max(0.5f, free_px_[static_cast<std::size_t>(pixel)]);
      const float weight = free_px * free_px * free_px * free_px;
      piece.middle.x += weight * at.x, piece.middle.y += weight * at.y;
      weights += weight;
      ++piece.pixels;
      members_.push_back(pixel);
      for_neighbours(pixel, [&](int next) {
        if (piece_of_[static_cast<std::size_t>(next)] >= 0 || field_.band(next) != field_.band(first)) return;
        piece_of_[static_cast<std::size_t>(next)] = number;
        open.push_back(next);
      });
    }
    piece.middle.x /= weights, piece.middle.y /= weights;
    all.push_back(piece);
  }

  template <typename Visit>
  void for_neighbours(int pixel, Visit visit) const {
    const int x = pixel % field_.width(), y = pixel / field_.width();
    for (const Step& step : kSteps) {
      const int to_x = x + step.dx, to_y = y + step.dy;
      if (to_x >= 0 && to_y >= 0 && to_x < field_.width() && to_y < field_.height())
        visit(field_.index(to_x, to_y));
    }
  }

  /// A piece grows out of the one that its first path comes from.
  void link() {
    for (const int pixel : members_) {
      Piece& piece = all[static_cast<std::size_t>(piece_of_[static_cast<std::size_t>(pixel)])];
      const int from = field_.before(pixel);
      if (piece.below >= 0 || from < 0 || field_.band(from) == field_.band(pixel)) continue;
      piece.below = piece_of_[static_cast<std::size_t>(from)];
    }
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].below >= 0) all[static_cast<std::size_t>(all[i].below)].above.push_back(static_cast<int>(i));
  }

  const DistanceFromFoot& field_;
  const std::vector<float>& free_px_;
  std::vector<int> piece_of_, members_;
};

/// The mask on a copy of its lowest row, downwards, so that discs do not end where the picture does.
Mask with_foot_drawn_out(const Mask& mask) {
  int foot = mask.height_px() - 1;
  const auto is_empty = [&](int y) {
    for (int x = 0; x < mask.width_px(); ++x)
      if (mask.get(x, y)) return false;
    return true;
  };
  while (foot > 0 && is_empty(foot)) --foot;
  Mask longer(mask.width_px(), mask.height_px() + mask.width_px() / 4);
  for (int y = 0; y < longer.height_px(); ++y)
    for (int x = 0; x < mask.width_px(); ++x)
      if (mask.get(x, std::min(y, foot))) longer.set(x, y);
  return longer;
}

/// A piece is as wide as it has pixels, and where others cross it or leave it, no wider than the largest disc
/// of the mask about its middle.
void measure_widths(const Mask& mask, const std::vector<float>& free_px, std::vector<Piece>& pieces) {
  constexpr float kOfPixel = 0.3f;  // a disc reaches to the middle of an unset pixel: over its edge
  const auto at = [&](int x, int y) {
    const int column = std::clamp(x, 0, mask.width_px() - 1), row = std::clamp(y, 0, mask.height_px() - 1);
    return free_px[static_cast<std::size_t>(row * mask.width_px() + column)];
  };
  for (Piece& piece : pieces) {
    float widest_px = 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        widest_px = std::max(
            widest_px, at(static_cast<int>(piece.middle.x) + dx, static_cast<int>(piece.middle.y) + dy));
    const float across_px = static_cast<float>(piece.pixels) / kBandPx;
    piece.width_px = std::min(across_px, 2 * std::max(0.5f, widest_px - kOfPixel));
  }
}

/// Follows pieces into axes: at each fork the axis goes on where the line is longest and bends least, of the
/// ways that leave all others the levels of branching that they need.
class AxisTracer {
 public:
  AxisTracer(std::vector<Piece> pieces, float shortest_px, int levels)
      : pieces_(std::move(pieces)), shortest_px_(shortest_px), levels_(levels) {
    for (std::size_t i = pieces_.size(); i-- > 0;) measure(pieces_[i]);
  }

  std::vector<MedialAxis> trace() {
    if (pieces_.empty()) return {};
    follow(0, -1, 0);
    for (std::size_t i = 0; i < axes_.size(); ++i) trace_children(static_cast<int>(i));
    return std::move(axes_);
  }

 private:
  Piece& piece(int index) { return pieces_[static_cast<std::size_t>(index)]; }

  void measure(Piece& at) {
    for (const int next : at.above)
      at.reach_px = std::max(at.reach_px, piece(next).reach_px + distance_px(at.middle, piece(next).middle));
    at.levels = levels_of(at);
  }

  /// The order of Strahler [1957, Quantitative analysis of watershed geomorphology]: where two ways need as
  /// many levels, one of them has to become a branch on the other.
  int levels_of(const Piece& at) {
    int most = 0, next_most = 0;
    for (const int next : at.above) {
      if (!is_long(at, next)) continue;
      next_most = std::max(next_most, std::min(most, piece(next).levels));
      most = std::max(most, piece(next).levels);
    }
    return std::max(most, next_most + 1);
  }

  /// Whether the way from a piece to one above it is long enough for an axis of its own.
  bool is_long(const Piece& from, int to) {
    const float reach_px = piece(to).reach_px + distance_px(from.middle, piece(to).middle);
    return reach_px - 0.5f * static_cast<float>(from.pixels) / kBandPx >= shortest_px_;
  }

  /// Whether all other ways from the piece can be branches of the axis that goes on there.
  bool leaves_levels(const Piece& at, int on, int levels) {
    return std::all_of(at.above.begin(), at.above.end(), [&](int other) {
      return other == on || piece(other).levels < levels || !is_long(at, other);
    });
  }

  /// Over how many pieces a line shows where it leads: over twice its width, as the first ones of a branch
  /// are drawn aside by what it stands on.
  static int pieces_of_direction(const Piece& at) {
    return std::max(4, static_cast<int>(2 * at.width_px / kBandPx));
  }

  /// The piece some way along the longest line: where a branch leads, not how its first pixels lie.
  PixelPoint ahead(const Piece& from, int pieces) {
    const Piece* at = &from;
    for (int i = 0; i < pieces && !at->above.empty(); ++i)
      at = &piece(*std::max_element(at->above.begin(), at->above.end(),
                                    [&](int a, int b) { return piece(a).reach_px < piece(b).reach_px; }));
    return at->middle;
  }

  PixelPoint behind(const Piece& from, int pieces) {
    const Piece* at = &from;
    for (int i = 0; i < pieces && at->below >= 0; ++i) at = &piece(at->below);
    return at->middle;
  }

  /// Where not all ways find levels enough, one of those that need most.
  void choose_way_on(Piece& at, int levels) {
    float best = -1;
    const int pieces = pieces_of_direction(at);
    const PixelPoint from = behind(at, pieces);
    const bool fits = at.levels <= levels;
    int most = 0;
    for (const int next : at.above) most = std::max(most, piece(next).levels);
    for (const int next : at.above) {
      if (fits ? !leaves_levels(at, next, levels) : piece(next).levels < most) continue;
      const PixelPoint to = ahead(piece(next), pieces);
      const float cosine =
          ((at.middle.x - from.x) * (to.x - at.middle.x) + (at.middle.y - from.y) * (to.y - at.middle.y)) /
          std::max(1e-3f, distance_px(from, at.middle) * distance_px(at.middle, to));
      const float merit = piece(next).reach_px * (1.5f + cosine);
      if (merit > best) best = merit, at.on = next;
    }
  }

  /// The axis from `first` to its tip; on a parent it begins at the piece it leaves. On one that may bear
  /// none it begins where that does, and runs along it to there.
  void follow(int first, int parent, float start) {
    MedialAxis axis{.parent = parent, .start = start};
    int levels = parent < 0 ? levels_ : levels_of_axis_[static_cast<std::size_t>(parent)] - 1;
    std::vector<int> along;
    if (levels == 0) {
      levels = 1;
      run_along(parent, piece(first).below, axis);
    }
    if (axis.runs_along >= 0)
      axis.points.push_back(piece(piece(first).below).middle);
    else if (parent >= 0)
      axis.points.push_back(origin_of(first, axis));
    for (int at = first; at >= 0; at = piece(at).on) {
      choose_way_on(piece(at), levels);
      along.push_back(at);
      axis.points.push_back(piece(at).middle);
    }
    if (axis.points.size() < 2) return;
    axis.width_px = median_width_px(along);
    axis.length_px = length_px(axis.points);
    axis.widths_px.assign(axis.points.size() - along.size(), piece(first).width_px);
    for (const int at : along) axis.widths_px.push_back(piece(at).width_px);
    axes_.push_back(std::move(axis));
    along_.push_back(std::move(along));
    levels_of_axis_.push_back(levels);
  }

  /// Where on its parent an axis begins that comes out of it at this piece: where its line meets the parent's
  /// when it is drawn back, no further down than the parent is wide. Moves its start there.
  PixelPoint origin_of(int first, MedialAxis& axis) {
    const MedialAxis& parent = axes_[static_cast<std::size_t>(axis.parent)];
    const PixelPoint from = piece(first).middle, to = ahead(piece(first), pieces_of_direction(piece(first)));
    const float long_px = std::max(1e-3f, distance_px(from, to));
    const float dx = (to.x - from.x) / long_px, dy = (to.y - from.y) / long_px;
    const auto off_px = [&](PixelPoint at) { return std::fabs((at.x - from.x) * dy - (at.y - from.y) * dx); };
    const PixelPoint fork = piece(piece(first).below).middle;
    std::size_t at = 0;
    for (std::size_t i = 0; i < parent.points.size(); ++i)
      if (distance_px(parent.points[i], fork) < distance_px(parent.points[at], fork)) at = i;
    const float width_px = parent.widths_px[at];
    float down_px = 0;
    while (at > 0 && off_px(parent.points[at - 1]) < off_px(parent.points[at])) {
      const float step_px = distance_px(parent.points[at - 1], parent.points[at]);
      if (down_px + step_px > width_px) break;
      down_px += step_px;
      --at;
    }
    axis.start = std::max(0.f, axis.start - down_px / parent.length_px);
    return parent.points[at];
  }

  /// Lets the axis begin with the points of another, up to the piece `to`.
  void run_along(int other_axis, int to, MedialAxis& axis) {
    const MedialAxis& other = axes_[static_cast<std::size_t>(other_axis)];
    const std::vector<int>& along = along_[static_cast<std::size_t>(other_axis)];
    const auto reached = static_cast<std::size_t>(std::find(along.begin(), along.end(), to) - along.begin());
    axis.parent = other.parent;
    axis.start = other.start;
    axis.runs_along = other_axis;
    axis.shared_points = other.points.size() - along.size() + reached;
    axis.points.assign(other.points.begin(),
                       other.points.begin() + static_cast<std::ptrdiff_t>(axis.shared_points));
  }

  float median_width_px(const std::vector<int>& along) {
    std::vector<int> pixels;
    for (std::size_t i = 0; i <= along.size() / 3 && i < along.size(); ++i)
      pixels.push_back(piece(along[i]).pixels);
    const auto middle = pixels.begin() + static_cast<std::ptrdiff_t>(pixels.size() / 2);
    std::nth_element(pixels.begin(), middle, pixels.end());
    return static_cast<float>(*middle) / kBandPx;
  }

  void trace_children(int parent) {
    if (levels_ == 1) return;
    const std::vector<int> along = along_[static_cast<std::size_t>(parent)];
    const float whole_px = axes_[static_cast<std::size_t>(parent)].length_px;
    float at_px =
        axes_[static_cast<std::size_t>(parent)].parent < 0
            ? 0
            : distance_px(axes_[static_cast<std::size_t>(parent)].points[0], piece(along[0]).middle);
    for (std::size_t i = 0; i < along.size(); ++i) {
      if (i > 0) at_px += distance_px(piece(along[i - 1]).middle, piece(along[i]).middle);
      for (const int next : piece(along[i]).above) {
        if (next == piece(along[i]).on || !is_long(piece(along[i]), next)) continue;
        follow(next, parent, at_px / whole_px);
      }
    }
  }

  std::vector<Piece> pieces_;
  float shortest_px_;
  int levels_;
  std::vector<MedialAxis> axes_;
  std::vector<std::vector<int>> along_;  ///< the pieces of each axis
  std::vector<int> levels_of_axis_;      ///< that are left from it on, with its own
};

}  // namespace

std::vector<MedialAxis> medial_axes(const Mask& mask, float shortest_px, int levels) {
  const DistanceFromFoot field(close_disc(mask, 1));
  const std::vector<float> free_px = distances_to_unset_px(with_foot_drawn_out(mask));
  std::vector<Piece> pieces = Pieces(field, free_px).all;
  measure_widths(mask, free_px, pieces);
  return AxisTracer(std::move(pieces), shortest_px, levels).trace();
}

std::vector<PixelPoint> evenly_spaced(const std::vector<PixelPoint>& line, std::size_t count) {
  const float step_px = length_px(line) / static_cast<float>(std::max<std::size_t>(1, count - 1));
  std::vector<PixelPoint> points{line.front()};
  float passed_px = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const float piece_px = distance_px(line[i - 1], line[i]);
    while (points.size() + 1 < count && static_cast<float>(points.size()) * step_px <= passed_px + piece_px) {
      const float t = (static_cast<float>(points.size()) * step_px - passed_px) / std::max(piece_px, 1e-6f);
      points.push_back({std::lerp(line[i - 1].x, line[i].x, t), std::lerp(line[i - 1].y, line[i].y, t)});
    }
    passed_px += piece_px;
  }
  while (points.size() < count) points.push_back(line.back());
  return points;
}

}  // namespace espalier
