#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

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
  float reach_px = 0;  ///< of the longest line from here to a tip
  int on = -1;         ///< the piece above that goes on along the axis
};

/// All pieces, each after the one below it.
class Pieces {
 public:
  explicit Pieces(const DistanceFromFoot& field) : field_(field), piece_of_(field.size(), -1) {
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
    std::vector<int> open{first};
    piece_of_[static_cast<std::size_t>(first)] = number;
    while (!open.empty()) {
      const int pixel = open.back();
      open.pop_back();
      const PixelPoint at = field_.point(pixel);
      piece.middle.x += at.x, piece.middle.y += at.y;
      ++piece.pixels;
      members_.push_back(pixel);
      for_neighbours(pixel, [&](int next) {
        if (piece_of_[static_cast<std::size_t>(next)] >= 0 || field_.band(next) != field_.band(first)) return;
        piece_of_[static_cast<std::size_t>(next)] = number;
        open.push_back(next);
      });
    }
    piece.middle.x /= static_cast<float>(piece.pixels), piece.middle.y /= static_cast<float>(piece.pixels);
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
  std::vector<int> piece_of_, members_;
};

/// Follows pieces into axes: at each fork the axis goes on where the line is longest and bends least.
class AxisTracer {
 public:
  AxisTracer(std::vector<Piece> pieces, float shortest_px)
      : pieces_(std::move(pieces)), shortest_px_(shortest_px) {
    for (std::size_t i = pieces_.size(); i-- > 0;) measure(pieces_[i]);
    for (std::size_t i = pieces_.size(); i-- > 0;) choose_way_on(pieces_[i]);
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
  }

  /// The piece some way along the longest line: where a branch leads, not how its first pixels lie.
  PixelPoint ahead(const Piece& from) {
    const Piece* at = &from;
    for (int i = 0; i < 4 && !at->above.empty(); ++i)
      at = &piece(*std::max_element(at->above.begin(), at->above.end(),
                                    [&](int a, int b) { return piece(a).reach_px < piece(b).reach_px; }));
    return at->middle;
  }

  PixelPoint behind(const Piece& from) {
    const Piece* at = &from;
    for (int i = 0; i < 4 && at->below >= 0; ++i) at = &piece(at->below);
    return at->middle;
  }

  void choose_way_on(Piece& at) {
    float best = -1;
    const PixelPoint from = behind(at);
    for (const int next : at.above) {
      const PixelPoint to = ahead(piece(next));
      const float cosine =
          ((at.middle.x - from.x) * (to.x - at.middle.x) + (at.middle.y - from.y) * (to.y - at.middle.y)) /
          std::max(1e-3f, distance_px(from, at.middle) * distance_px(at.middle, to));
      const float merit = piece(next).reach_px * (1.5f + cosine);
      if (merit > best) best = merit, at.on = next;
    }
  }

  /// The axis from `first` to its tip; on a parent it begins at the piece it leaves.
  void follow(int first, int parent, float start) {
    MedialAxis axis{.parent = parent, .start = start};
    std::vector<int> along;
    if (parent >= 0) axis.points.push_back(piece(piece(first).below).middle);
    for (int at = first; at >= 0; at = piece(at).on) {
      along.push_back(at);
      axis.points.push_back(piece(at).middle);
    }
    if (axis.points.size() < 2) return;
    axis.width_px = median_width_px(along);
    axis.length_px = length_px(axis.points);
    axes_.push_back(std::move(axis));
    along_.push_back(std::move(along));
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
    const std::vector<int> along = along_[static_cast<std::size_t>(parent)];
    const float whole_px = axes_[static_cast<std::size_t>(parent)].length_px;
    float at_px =
        axes_[static_cast<std::size_t>(parent)].parent < 0
            ? 0
            : distance_px(axes_[static_cast<std::size_t>(parent)].points[0], piece(along[0]).middle);
    for (std::size_t i = 0; i < along.size(); ++i) {
      if (i > 0) at_px += distance_px(piece(along[i - 1]).middle, piece(along[i]).middle);
      for (const int next : piece(along[i]).above) {
        const float reach_px = piece(next).reach_px + distance_px(piece(along[i]).middle, piece(next).middle);
        const float inside_px = 0.5f * static_cast<float>(piece(along[i]).pixels) / kBandPx;
        if (next == piece(along[i]).on || reach_px - inside_px < shortest_px_) continue;
        follow(next, parent, at_px / whole_px);
      }
    }
  }

  std::vector<Piece> pieces_;
  float shortest_px_;
  std::vector<MedialAxis> axes_;
  std::vector<std::vector<int>> along_;  ///< the pieces of each axis
};

}  // namespace

std::vector<MedialAxis> medial_axes(const Mask& mask, float shortest_px) {
  const DistanceFromFoot field(close_disc(mask, 1));
  return AxisTracer(Pieces(field).all, shortest_px).trace();
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
