#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <espalier/charts/line_chart.h>
#include <espalier/fitting/species_pictures/plant_pictures.h>
#include <espalier/fitting/species_pictures/species_map.h>

namespace espalier {

namespace {

constexpr int kWidthPx = 1560, kHeightPx = 1000, kTreePx = 92;
constexpr float kLeftPx = 90, kRightPx = 1120, kTopPx = 24, kBottomPx = 920, kTextPx = 18;
constexpr std::size_t kArrows = 10;
constexpr Rgb kInk{60, 60, 60}, kGrid{230, 230, 230}, kPoint{213, 94, 0}, kLeader{150, 150, 150},
    kArrow{0, 114, 178};

/// Maps coordinates to pixels, with the same scale on both axes.
struct MapScale {
  double middle_x = 0, middle_y = 0, px_per_unit = 1;

  ChartPoint to_px(double x, double y) const {
    return {static_cast<float>((kLeftPx + kRightPx) / 2 + (x - middle_x) * px_per_unit),
            static_cast<float>((kTopPx + kBottomPx) / 2 - (y - middle_y) * px_per_unit)};
  }
  double x_at(float px) const { return middle_x + (px - (kLeftPx + kRightPx) / 2) / px_per_unit; }
  double y_at(float px) const { return middle_y - (px - (kTopPx + kBottomPx) / 2) / px_per_unit; }
};

/// A tree with its name under it: the upper left corner and the size.
struct TreeBox {
  ChartPoint point;  ///< of the species
  float x, y, width, height;
};

double second(const Eigen::VectorXd& coordinates) { return coordinates.size() > 1 ? coordinates[1] : 0; }

MapScale fit_scale(const SpeciesSpace& space) {
  double low_x = INFINITY, high_x = -INFINITY, low_y = INFINITY, high_y = -INFINITY;
  for (const SpeciesPoint& species : space.species) {
    low_x = std::min(low_x, species.coordinates[0]), high_x = std::max(high_x, species.coordinates[0]);
    low_y = std::min(low_y, second(species.coordinates)),
    high_y = std::max(high_y, second(species.coordinates));
  }
  const double room_x = kRightPx - kLeftPx - 1.6 * kTreePx, room_y = kBottomPx - kTopPx - 1.6 * kTreePx;
  const double width = std::max(high_x - low_x, 1e-9), height = std::max(high_y - low_y, 1e-9);
  return {(low_x + high_x) / 2, (low_y + high_y) / 2, std::min(room_x / width, room_y / height)};
}

void add_axes(const MapScale& scale, ChartLayout& layout) {
  for (const double tick : axis_ticks(scale.x_at(kLeftPx), scale.x_at(kRightPx), 8)) {
    const float x = scale.to_px(tick, 0).x_px;
    layout.strokes.push_back({{{x, kTopPx}, {x, kBottomPx}}, kGrid, tick == 0 ? 3.0f : 1.0f});
    layout.labels.push_back({{x, kBottomPx + kTextPx}, fmt::format("{:g}", tick)});
  }
  for (const double tick : axis_ticks(scale.y_at(kBottomPx), scale.y_at(kTopPx), 8)) {
    const float y = scale.to_px(0, tick).y_px;
    layout.strokes.push_back({{{kLeftPx, y}, {kRightPx, y}}, kGrid, tick == 0 ? 3.0f : 1.0f});
    layout.labels.push_back({{kLeftPx - 10, y}, fmt::format("{:g}", tick), TextAnchor::end});
  }
  layout.strokes.push_back({{{kLeftPx, kTopPx}, {kLeftPx, kBottomPx}, {kRightPx, kBottomPx}}, kInk, 1});
}

std::string axis_title(const SpeciesSpace& space, int index) {
  if (index >= space.dimension()) return "";
  return fmt::format("component {}: {:.1f} % of the variance", index + 1, 100 * space.pca.explained(index));
}

/// Moves two boxes apart, along the axis on which their points are further apart for boxes of this size. True
/// where they overlapped.
bool push_apart(TreeBox& a, TreeBox& b) {
  const float overlap_x = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const float overlap_y = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  if (overlap_x <= 0 || overlap_y <= 0) return false;
  const float apart_x = b.point.x_px - a.point.x_px, apart_y = b.point.y_px - a.point.y_px;
  if (std::fabs(apart_x) * (a.height + b.height) > std::fabs(apart_y) * (a.width + b.width)) {
    const float half = std::copysign((overlap_x + 1) / 2, apart_x);
    a.x -= half, b.x += half;
  } else {
    const float half = std::copysign((overlap_y + 1) / 2, apart_y);
    a.y -= half, b.y += half;
  }
  return true;
}

/// Moves a box off the point of another species, by the shortest way.
void push_off(TreeBox& box, ChartPoint point) {
  constexpr float kRoomPx = 9;
  const float left = point.x_px + kRoomPx - box.x, right = box.x + box.width - (point.x_px - kRoomPx);
  const float up = point.y_px + kRoomPx - box.y, down = box.y + box.height - (point.y_px - kRoomPx);
  const float shortest = std::min({left, right, up, down});
  if (shortest <= 0) return;
  if (shortest == left)
    box.x += left;
  else if (shortest == right)
    box.x -= right;
  else
    box.y += shortest == up ? up : -down;
}

void keep_on_map(TreeBox& box) {
  box.x = std::clamp(box.x, kLeftPx + 2, kRightPx - box.width);
  box.y = std::clamp(box.y, kTopPx, kBottomPx - box.height - 2);
}

/// Towards its point, by a share of the way.
void pull_home(TreeBox& box, float share) {
  box.x += share * (box.point.x_px - box.width / 2 - box.x);
  box.y += share * (box.point.y_px - box.height / 2 - box.y);
}

void push_off_points(std::vector<TreeBox>& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < boxes.size(); ++j)
      if (i != j) push_off(boxes[i], boxes[j].point);
}

/// Pulls boxes to their points ever more weakly while it pushes them apart and off the points of others; then
/// only apart, since no box may cover another, though one may have to cover a point.
void spread(std::vector<TreeBox>& boxes) {
  constexpr int kPulls = 400, kRounds = 3000;
  bool moved = true;
  for (int round = 0; round < kPulls || (moved && round < kRounds); ++round) {
    moved = false;
    for (TreeBox& box : boxes)
      pull_home(box, std::max(0.0f, 0.2f * (1 - static_cast<float>(round) / kPulls)));
    if (round < kPulls) push_off_points(boxes);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t j = i + 1; j < boxes.size(); ++j) moved = push_apart(boxes[i], boxes[j]) || moved;
    for (TreeBox& box : boxes) keep_on_map(box);
  }
}

std::vector<TreeBox> place_trees(const SpeciesSpace& space, const MapScale& scale) {
  std::vector<TreeBox> boxes;
  for (const SpeciesPoint& species : space.species) {
    const ChartPoint point = scale.to_px(species.coordinates[0], second(species.coordinates));
    const float width = std::max<float>(kTreePx, text_width_px(species.name) + 16),
                height = kTreePx + kTextPx;
    boxes.push_back({point, point.x_px - width / 2, point.y_px - height / 2, width, height});
    keep_on_map(boxes.back());
  }
  spread(boxes);
  return boxes;
}

void add_tree(const SpeciesSpace& space, const SpeciesPoint& species, const TreeBox& box,
              ChartLayout& layout) {
  const float middle = box.x + box.width / 2;
  layout.strokes.push_back({{box.point, {middle, box.y + box.height / 2}}, kLeader, 1});
  layout.strokes.push_back({{box.point}, kPoint, 9});
  CutOutPlant tree = cut_out_plant(*space.model, species.values, {.size_px = kTreePx});
  layout.images.push_back({{middle - kTreePx / 2.0f, box.y}, std::move(tree.picture), std::move(tree.cover)});
  layout.labels.push_back({{middle, box.y + kTreePx + kTextPx / 2}, species.name});
}

void add_arrow(ChartPoint from, ChartPoint to, ChartLayout& layout) {
  layout.strokes.push_back({{from, to}, kArrow, 2});
  const float x = to.x_px - from.x_px, y = to.y_px - from.y_px, length = std::max(std::hypot(x, y), 1e-3f);
  const float u = 9 * x / length, v = 9 * y / length;
  layout.strokes.push_back(
      {{{to.x_px - u + v / 2, to.y_px - v - u / 2}, to, {to.x_px - u - v / 2, to.y_px - v + u / 2}},
       kArrow,
       2});
}

/// A panel beside the map: arrows by number, and the names in a list.
void add_loadings(const SpeciesSpace& space, ChartLayout& layout) {
  constexpr float kMiddleX = 1340, kMiddleY = 240, kRadius = 160, kListX = 1170, kListY = 480, kLinePx = 26;
  const std::vector<Loading> loadings = strongest_loadings(space, kArrows);
  layout.labels.push_back({{kMiddleX, 30}, "strongest parameters"});
  layout.strokes.push_back({{{kMiddleX - kRadius, kMiddleY}, {kMiddleX + kRadius, kMiddleY}}, kGrid, 1});
  layout.strokes.push_back({{{kMiddleX, kMiddleY - kRadius}, {kMiddleX, kMiddleY + kRadius}}, kGrid, 1});
  const auto length = [](const Loading& loading) {
    return std::hypot(loading.on_components[0], second(loading.on_components));
  };
  double longest = 1e-12;
  for (const Loading& loading : loadings) longest = std::max(longest, length(loading));
  std::vector<TreeBox> numbers;
  for (const Loading& loading : loadings) {
    const double scale = kRadius / longest;
    const ChartPoint tip{static_cast<float>(kMiddleX + scale * loading.on_components[0]),
                         static_cast<float>(kMiddleY - scale * second(loading.on_components))};
    add_arrow({kMiddleX, kMiddleY}, tip, layout);
    const double out = 1 + 16 / std::max(1.0, scale * length(loading));
    const float x = static_cast<float>(kMiddleX + out * (tip.x_px - kMiddleX)) - 13;
    const float y = static_cast<float>(kMiddleY + out * (tip.y_px - kMiddleY)) - 9;
    numbers.push_back({tip, x, y, 26, 18});
  }
  for (int round = 0; round < 200; ++round)
    for (std::size_t i = 0; i < numbers.size(); ++i)
      for (std::size_t j = i + 1; j < numbers.size(); ++j) push_apart(numbers[i], numbers[j]);
  for (std::size_t i = 0; i < loadings.size(); ++i) {
    layout.labels.push_back({{numbers[i].x + 13, numbers[i].y + 9}, fmt::format("{}", i + 1)});
    layout.labels.push_back({{kListX, kListY + kLinePx * static_cast<float>(i)},
                             fmt::format("{:>2} {}", i + 1, loadings[i].column),
                             TextAnchor::start});
  }
}

}  // namespace

SpeciesMap draw_species_map(const SpeciesSpace& space) {
  SpeciesMap map{{}, kWidthPx, kHeightPx};
  const MapScale scale = fit_scale(space);
  add_axes(scale, map.layout);
  const std::vector<TreeBox> boxes = place_trees(space, scale);
  for (std::size_t i = 0; i < boxes.size(); ++i) add_tree(space, space.species[i], boxes[i], map.layout);
  add_loadings(space, map.layout);
  map.layout.labels.push_back({{(kLeftPx + kRightPx) / 2, kBottomPx + 3 * kTextPx}, axis_title(space, 0)});
  map.layout.labels.push_back(
      {{22, (kTopPx + kBottomPx) / 2}, axis_title(space, 1), TextAnchor::middle, true});
  return map;
}

}  // namespace espalier
